# DICOM. Those that change or transcode files use DCMTK themselves; the writer of synthetic series does not.
find_package(DCMTK REQUIRED CONFIG)
find_package(ZLIB REQUIRED)

pellucid_test(NAME io_dicom_geometry LABELS io SOURCES dicom_geometry_test.cpp LIBRARIES pellucid_io)
pellucid_test(NAME io_dicom LABELS io
  SOURCES dicom_series_test.cpp dicom_scan_test.cpp dicom_refusal_test.cpp dicom_sample_test.cpp
    ../support/synthetic_dicom.cpp
  LIBRARIES pellucid_io ZLIB::ZLIB)
pellucid_test(NAME io_dicom_codecs LABELS io
  SOURCES dicom_codec_test.cpp ../support/synthetic_dicom.cpp
  LIBRARIES pellucid_io DCMTK::dcmdata DCMTK::dcmjpeg DCMTK::dcmjpls)
pellucid_test(NAME io_dicom_hostile LABELS io TIMEOUT 300
  SOURCES dicom_hostile_test.cpp ../support/allocation_watch.cpp ../support/synthetic_dicom.cpp
  LIBRARIES pellucid_io DCMTK::dcmdata DCMTK::dcmjpeg DCMTK::dcmjpls ZLIB::ZLIB)

if(PELLUCID_CORPUS_DIR)
  pellucid_test(NAME corpus_dicom LABELS corpus TIMEOUT 300
    SOURCES dicom_corpus_test.cpp dicom_corpus_truth_test.cpp
    LIBRARIES pellucid_io ZLIB::ZLIB
    ENVIRONMENT PELLUCID_CORPUS=${PELLUCID_CORPUS_DIR})
endif()
