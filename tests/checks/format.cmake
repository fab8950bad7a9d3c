# All C and C++ files are as clang-format of Debian 12 (14) writes them with .clang-format.
find_program(tool NAMES clang-format-14 clang-format)
if(NOT tool)
    message("SKIP: no clang-format")
    return()
endif()
file(GLOB_RECURSE files ${ROOT}/src/*.[ch] ${ROOT}/src/*.cpp ${ROOT}/tests/*.[ch]
     ${ROOT}/bench/*.[ch] ${ROOT}/bench/*.cpp)
execute_process(COMMAND ${tool} --style=file --dry-run --Werror ${files}
                RESULT_VARIABLE result ERROR_VARIABLE text)
if(NOT result EQUAL 0)
    message(FATAL_ERROR "run clang-format -i on:\n${text}")
endif()
