# embed.cmake - writes shaders as C: cmake -DFOLDER=shaders -DNAMES=a;b -DOUTPUT=c -P embed.cmake
set(texts)
set(rows)
set(count 0)
foreach(name ${NAMES})
    file(READ ${FOLDER}/${name} bytes HEX)
    string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
    string(APPEND texts "static const char text_${count}[] = {${bytes}0};\n")
    string(APPEND rows "    {\"${name}\", text_${count}},\n")
    math(EXPR count "${count} + 1")
endforeach()
file(WRITE ${OUTPUT} "#include \"render/gl/source.h\"\n\n${texts}
const struct gl_file gl_files[] = {\n${rows}};\nconst size_t gl_file_count = ${count};\n")
