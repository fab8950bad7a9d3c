# Each header compiles alone, and twice in one file.
file(GLOB_RECURSE headers RELATIVE ${ROOT}/src ${ROOT}/src/*.h)
set(faults)
foreach(header ${headers})
    execute_process(
        COMMAND ${CMAKE_COMMAND} -E echo "#include \"${header}\"\n#include \"${header}\""
        COMMAND ${CC} -std=c11 -D_GNU_SOURCE -Wall -Wextra -Wshadow -Wconversion -Wstrict-prototypes
                -Werror -Wno-psabi -fsyntax-only -I ${ROOT}/src -I ${ROOT} -x c -
        RESULT_VARIABLE result ERROR_VARIABLE text)
    if(NOT result EQUAL 0)
        list(APPEND faults "${header}:\n${text}")
    endif()
endforeach()
if(faults)
    list(JOIN faults "\n" text)
    message(FATAL_ERROR "headers that do not stand alone:\n${text}")
endif()
