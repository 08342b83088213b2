# forelock_spirv(NAME SOURCE FOLDER flags...): SOURCE compiled, validated and embedded as the array NAME in FOLDER/NAME.h.
# Two steps, because the dependencies that glslang writes are those of the .spv, and ninja wants them named so.
find_program(GLSLANG glslangValidator REQUIRED)
find_program(SPIRV_VAL spirv-val REQUIRED)
set(FORELOCK_EMBED ${CMAKE_CURRENT_LIST_DIR}/embed.cmake)

function(forelock_spirv name source folder)
  set(base ${folder}/${name})
  add_custom_command(OUTPUT ${base}.spv
    COMMAND ${GLSLANG} -V --target-env vulkan1.2 --quiet ${ARGN} --depfile ${base}.d -o ${base}.spv ${source}
    COMMAND ${SPIRV_VAL} --target-env vulkan1.2 --scalar-block-layout ${base}.spv
    DEPENDS ${source} DEPFILE ${base}.d VERBATIM
    COMMENT "Shader ${name}")
  add_custom_command(OUTPUT ${base}.h
    COMMAND ${CMAKE_COMMAND} -DINPUT=${base}.spv -DOUTPUT=${base}.h -DNAME=${name} -P ${FORELOCK_EMBED}
    DEPENDS ${base}.spv ${FORELOCK_EMBED} VERBATIM
    COMMENT "Embedding ${name}")
endfunction()
