#include "asset/codec.h"

namespace forelock {

const Codec* findCodec(uint32_t format) noexcept {
  for (const Codec* codec : {&tfx_codec, &hair_codec, &tfx_text_codec, &strand_data_codec, &ply_codec})
    if (codec->format == format) return codec;
  return nullptr;
}

}  // namespace forelock
