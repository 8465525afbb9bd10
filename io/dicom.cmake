# DICOM through DCMTK, which stays private to this room.
find_package(DCMTK REQUIRED CONFIG)
find_package(ZLIB REQUIRED)
find_package(Threads REQUIRED)
find_package(fmt REQUIRED)

target_sources(pellucid_io PRIVATE
  dicom_bytes.cpp
  dicom_dataset.cpp
  dicom_geometry.cpp
  dicom_header.cpp
  dicom_pixels.cpp
  dicom_scan.cpp
  dicom_series.cpp
  dicom_structure.cpp)
target_link_libraries(pellucid_io PRIVATE
  DCMTK::dcmdata DCMTK::dcmjpeg DCMTK::dcmjpls DCMTK::oflog DCMTK::ofstd ZLIB::ZLIB Threads::Threads fmt::fmt)
