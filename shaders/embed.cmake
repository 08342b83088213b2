# SPIR-V words as a C++ array.
file(READ ${INPUT} hex HEX)
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${hex}")
file(WRITE ${OUTPUT} "#pragma once\n#include <cstdint>\ninline constexpr std::uint32_t ${NAME}[] = {${words}};\n")
