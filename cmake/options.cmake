# Warnings, floating-point rules and sanitizers, for every target of the project.

option(HCSG_WERROR "treat warnings as errors" OFF)
set(HCSG_SANITIZE "" CACHE STRING "sanitizers to build with, e.g. address,undefined")

# No fused multiply-add unless written: the same numbers on every processor and at every
# optimisation level, so that pictures are bit-identical wherever they are made.
add_compile_options(-ffp-contract=off -fno-math-errno)

add_library(hcsg_warnings INTERFACE)
target_compile_options(hcsg_warnings INTERFACE
    -Wall -Wextra -Wshadow -Wconversion
    $<$<COMPILE_LANGUAGE:C>:-Wstrict-prototypes -Wmissing-prototypes>)
if(HCSG_WERROR)
    target_compile_options(hcsg_warnings INTERFACE -Werror)
endif()
if(HCSG_SANITIZE)
    add_compile_options(-fsanitize=${HCSG_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    add_link_options(-fsanitize=${HCSG_SANITIZE})
endif()

# hcsg_library(base a.c b.c ...): the folder src/base as the static library hcsg_base.
function(hcsg_library name)
    add_library(hcsg_${name} STATIC ${ARGN})
    target_include_directories(hcsg_${name} PUBLIC ${PROJECT_SOURCE_DIR}/src)
    target_link_libraries(hcsg_${name} PRIVATE hcsg_warnings)
endfunction()

# hcsg_program(hcsg-render render_main.c libs...): a program, in the top of the build folder so that
# ./build/hcsg-render starts it, installed with its man page docs/hcsg-render.1.
function(hcsg_program name main)
    add_executable(${name} ${main})
    target_compile_definitions(${name} PRIVATE HCSG_VERSION="${PROJECT_VERSION}")
    target_link_libraries(${name} PRIVATE ${ARGN} hcsg_warnings)
    set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
    install(TARGETS ${name} DESTINATION ${CMAKE_INSTALL_BINDIR})
    install(FILES ${PROJECT_SOURCE_DIR}/docs/${name}.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
endfunction()
