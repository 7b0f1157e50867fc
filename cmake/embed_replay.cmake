# Turns the replay page's parts into a C++ source, so that one program holds all that a page needs.
#
# Included by CMake: finds three.js and offers embed_replay(target). Run as a script by the build
# (cmake -P, whenever a part has changed): writes the source that src/scene/replay_assets.h declares.
# Text goes into raw string literals, in pieces that every compiler takes (clang's limit is 65536).

if(CMAKE_SCRIPT_MODE_FILE)
  # Takes OUTPUT, HTML, STYLE, THREE and PLAYER (a list).
  function(append_asset name)
    set(text "")
    foreach(path IN LISTS ARGN)
      file(READ "${path}" part)
      if(path MATCHES "\\.js$" AND part MATCHES "</script|<!--")
        message(FATAL_ERROR "${path} holds '</script' or '<!--', which would end the page's script")
      endif()
      string(APPEND text "${part}\n")
    endforeach()
    set(pieces "")
    string(LENGTH "${text}" length)
    set(start 0)
    while(start LESS length)
      string(SUBSTRING "${text}" ${start} 30000 piece)
      string(APPEND pieces "    R\"cairn(${piece})cairn\"sv,\n")
      math(EXPR start "${start} + 30000")
    endwhile()
    file(APPEND "${OUTPUT}.new" "constexpr std::string_view ${name}_pieces[] = {\n${pieces}};\n"
      "const Pieces ${name} = ${name}_pieces;\n\n")
  endfunction()

  file(WRITE "${OUTPUT}.new"
    "// Written by cmake/embed_replay.cmake from web/replay/ and three.js.\n"
    "#include \"scene/replay_assets.h\"\n\n"
    "namespace cairn::scene::assets {\n\nusing std::string_view_literals::operator\"\"sv;\n\n")
  append_asset(page_html ${HTML})
  append_asset(style_css ${STYLE})
  append_asset(three_js ${THREE})
  append_asset(player_js ${PLAYER})
  file(APPEND "${OUTPUT}.new" "}  // namespace cairn::scene::assets\n")
  file(RENAME "${OUTPUT}.new" "${OUTPUT}")
  return()
endif()

find_file(CAIRN_THREE_JS three.min.js
  PATHS /usr/share/javascript/three /usr/share/nodejs/three/build
  DOC "three.js as one classic script, release 111 (Debian's package libjs-three)")
if(NOT CAIRN_THREE_JS)
  message(FATAL_ERROR
    "three.min.js was not found: the replay page (cairn run --replay) is drawn with three.js r111. "
    "Install Debian's package libjs-three (apt-get install libjs-three), or take build/three.min.js "
    "of npm's three@0.111.0 and say -DCAIRN_THREE_JS=/path/to/three.min.js.")
endif()

function(embed_replay target)
  set(web ${PROJECT_SOURCE_DIR}/web/replay)
  # In the order in which they must run.
  set(player "")
  foreach(part decode palette shaders stage orbit picking overlays plots panel controls motion api main)
    list(APPEND player ${web}/${part}.js)
  endforeach()
  set(output ${CMAKE_CURRENT_BINARY_DIR}/replay_assets.cpp)
  string(REPLACE ";" "\\;" player_argument "${player}")
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${output} -DHTML=${web}/page.html -DSTYLE=${web}/style.css
      -DTHREE=${CAIRN_THREE_JS} "-DPLAYER=${player_argument}"
      -P ${PROJECT_SOURCE_DIR}/cmake/embed_replay.cmake
    DEPENDS ${web}/page.html ${web}/style.css ${player} ${CAIRN_THREE_JS}
      ${PROJECT_SOURCE_DIR}/cmake/embed_replay.cmake
    COMMENT "Embedding the replay page"
    VERBATIM)
  target_sources(${target} PRIVATE ${output})
endfunction()
