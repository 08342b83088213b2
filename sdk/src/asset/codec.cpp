#include "asset/codec.h"

namespace forelock {

const Codec* findCodec(uint32_t format) noexcept {
  for (const Codec* codec : {&tfx_codec, &hair_codec})
    if (codec->format == format) return codec;
  return nullptr;
}

}  // namespace forelock
