# OpenCV module by module, without Debian's OpenCVConfig.cmake: that one lies in libopencv-dev, which pulls in VTK, GDAL
# and Qt, and it refuses to work when any module of OpenCV is missing. Gives the targets opencv_<module> and the usual
# variables (OpenCV_INCLUDE_DIRS, OpenCV_LIBS, OpenCV_VERSION).
find_path(OpenCV_INCLUDE_DIR opencv2/core/version.hpp PATH_SUFFIXES opencv4)
mark_as_advanced(OpenCV_INCLUDE_DIR)

if(OpenCV_INCLUDE_DIR)
  file(STRINGS ${OpenCV_INCLUDE_DIR}/opencv2/core/version.hpp _opencv_version
    REGEX "^#define CV_VERSION_(MAJOR|MINOR|REVISION) +[0-9]+")
  string(REGEX REPLACE "[^0-9;]" "" _opencv_version "${_opencv_version}")
  string(REPLACE ";" "." OpenCV_VERSION "${_opencv_version}")
endif()

set(OpenCV_INCLUDE_DIRS ${OpenCV_INCLUDE_DIR})
set(OpenCV_LIBS)
foreach(_module ${OpenCV_FIND_COMPONENTS})
  find_library(OpenCV_${_module}_LIBRARY opencv_${_module})
  mark_as_advanced(OpenCV_${_module}_LIBRARY)
  if(OpenCV_${_module}_LIBRARY)
    set(OpenCV_${_module}_FOUND TRUE)
    list(APPEND OpenCV_LIBS opencv_${_module})
    if(NOT TARGET opencv_${_module})
      add_library(opencv_${_module} UNKNOWN IMPORTED GLOBAL)
      set_target_properties(opencv_${_module} PROPERTIES IMPORTED_LOCATION ${OpenCV_${_module}_LIBRARY}
        INTERFACE_INCLUDE_DIRECTORIES ${OpenCV_INCLUDE_DIR})
    endif()
  endif()
endforeach()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenCV REQUIRED_VARS OpenCV_INCLUDE_DIR VERSION_VAR OpenCV_VERSION HANDLE_COMPONENTS)
