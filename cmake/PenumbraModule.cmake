# A folder is a target. USES names the folders it may include (the layer order, also checked by
# tests/check_layers.py); THIRD_PARTY stays private, so that its headers stay in this folder's .cpp files.
function(penumbra_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;USES;THIRD_PARTY" ${ARGN})
  add_library(penumbra_${name} STATIC ${ARG_SOURCES})
  add_library(Penumbra::${name} ALIAS penumbra_${name})
  target_compile_features(penumbra_${name} PUBLIC cxx_std_20)
  target_include_directories(penumbra_${name} PUBLIC ${PROJECT_SOURCE_DIR})
  list(TRANSFORM ARG_USES PREPEND Penumbra::)
  target_link_libraries(penumbra_${name}
    PUBLIC glm::glm ${ARG_USES}
    PRIVATE ${ARG_THIRD_PARTY} Penumbra::warnings)
endfunction()

# One test program a folder; every case becomes a CTest test named <name>.<Suite>.<Case>. Random tests try the same
# every time, TRIES things each (100 if that is not said).
function(penumbra_test name)
  cmake_parse_arguments(ARG "" "TRIES" "SOURCES;USES;THIRD_PARTY" ${ARGN})
  if(NOT ARG_TRIES)
    set(ARG_TRIES 100)
  endif()
  add_executable(test_${name} ${ARG_SOURCES})
  list(TRANSFORM ARG_USES PREPEND Penumbra::)
  target_link_libraries(test_${name} PRIVATE
    ${ARG_USES} ${ARG_THIRD_PARTY} GTest::gmock_main rapidcheck rapidcheck_gtest Penumbra::warnings)
  target_compile_definitions(test_${name} PRIVATE
    PENUMBRA_SOURCE_DIR="${PROJECT_SOURCE_DIR}" PENUMBRA_PROGRAM="${PROJECT_BINARY_DIR}/penumbra")
  gtest_discover_tests(test_${name} TEST_PREFIX ${name}. DISCOVERY_MODE PRE_TEST
    PROPERTIES TIMEOUT 300 ENVIRONMENT "RC_PARAMS=seed=1 max_success=${ARG_TRIES}")
endfunction()
