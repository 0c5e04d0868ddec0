# Everything Penumbra builds with; all of it comes from Debian (scripts/deps installs it).
find_package(PkgConfig REQUIRED)
find_package(glm REQUIRED CONFIG)
find_package(TBB REQUIRED CONFIG)
find_package(Boost REQUIRED) # Interprocess: headers only
find_package(embree 3 REQUIRED CONFIG)
find_package(OpenEXR REQUIRED CONFIG)
find_package(PNG REQUIRED)
find_package(JPEG REQUIRED)
find_package(assimp 5 REQUIRED CONFIG)
find_package(CLI11 REQUIRED CONFIG)
find_package(fmt REQUIRED CONFIG)
find_package(nlohmann_json REQUIRED CONFIG)
find_package(glfw3 3.3 REQUIRED CONFIG)
find_package(OpenGL REQUIRED COMPONENTS OpenGL EGL)
pkg_check_modules(lz4 REQUIRED IMPORTED_TARGET liblz4)
pkg_check_modules(epoxy REQUIRED IMPORTED_TARGET epoxy)
pkg_check_modules(imgui REQUIRED IMPORTED_TARGET imgui)

# Debian's OpenSubdivConfig.cmake names a static library that is not shipped, so look for it here.
find_path(OPENSUBDIV_INCLUDE_DIR opensubdiv/version.h REQUIRED)
find_library(OPENSUBDIV_CPU_LIBRARY osdCPU REQUIRED)
add_library(OpenSubdiv::osdCPU UNKNOWN IMPORTED)
set_target_properties(OpenSubdiv::osdCPU PROPERTIES
  IMPORTED_LOCATION ${OPENSUBDIV_CPU_LIBRARY}
  INTERFACE_INCLUDE_DIRECTORIES ${OPENSUBDIV_INCLUDE_DIR})

# Debian's OpenImageIOConfig.cmake wants headers of OpenCV, which its package does not depend on.
find_path(OPENIMAGEIO_INCLUDE_DIR OpenImageIO/imageio.h REQUIRED)
find_library(OPENIMAGEIO_LIBRARY OpenImageIO REQUIRED)
find_library(OPENIMAGEIO_UTIL_LIBRARY OpenImageIO_Util REQUIRED)
add_library(OpenImageIO::OpenImageIO UNKNOWN IMPORTED)
set_target_properties(OpenImageIO::OpenImageIO PROPERTIES
  IMPORTED_LOCATION ${OPENIMAGEIO_LIBRARY}
  INTERFACE_INCLUDE_DIRECTORIES ${OPENIMAGEIO_INCLUDE_DIR}
  INTERFACE_LINK_LIBRARIES "${OPENIMAGEIO_UTIL_LIBRARY};Imath::Imath")

if(BUILD_TESTING)
  find_package(GTest REQUIRED CONFIG)
  find_package(rapidcheck REQUIRED CONFIG)
  include(GoogleTest)
endif()
if(PENUMBRA_BENCH)
  find_package(benchmark REQUIRED CONFIG)
endif()
