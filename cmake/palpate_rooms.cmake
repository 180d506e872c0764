# For a build that is not worked on (PALPATE_ROOMS: deploy/demo.sh, deploy/test.sh): the files of a room are compiled as one, or
# a few where there are many. Most of a unit's time goes into its headers. Names in the unnamed namespaces of a room differ.
set(files_at_once 10)

# palpate_rooms(TARGET): groups its files by their folder. Those with options of their own stay alone.
function(palpate_rooms target)
  get_target_property(files ${target} SOURCES)
  get_target_property(folder ${target} SOURCE_DIR)
  set(rooms)
  foreach(file ${files})
    cmake_path(ABSOLUTE_PATH file BASE_DIRECTORY ${folder} NORMALIZE)
    if(NOT file MATCHES "[.]cpp$")
      continue()
    endif()
    cmake_path(GET file PARENT_PATH room)
    cmake_path(RELATIVE_PATH room BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
    string(MAKE_C_IDENTIFIER ${room} room)
    math(EXPR count_${room} "0${count_${room}} + 1")
    math(EXPR part "(${count_${room}} - 1) / ${files_at_once}")
    set_property(SOURCE ${file} TARGET_DIRECTORY ${target} PROPERTY UNITY_GROUP ${room}_${part})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()
