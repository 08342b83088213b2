// The tail of a pixel: what lies behind the core (docs/methods.md section 6). Included after bindings.glsl.
#ifndef FORELOCK_PASSES_TAIL
#define FORELOCK_PASSES_TAIL

layout(constant_id = FLK_SPEC_TAIL) const int kTail = FLK_TAIL_KIND_LIST;
const float kColorSteps = 256.0;  // of colour, for each step of tau

// In list order: color over what came before. As a mean: integer sums, which no order changes.
struct Tail {
  vec3 color;
  float transmittance;
  uint tau;           // 2^-16
  uvec3 low, high;    // sums of tau times colour: 64 bits
  bool opaque;        // a fragment of opacity 1 is among them, which its tau, the greatest of a fragment, does not say
};

Tail emptyTail() { return Tail(vec3(0.0), 1.0, 0u, uvec3(0u), uvec3(0u), false); }

uint tauSteps(float alpha) { return uint(min(-log2(max(1.0 - alpha, 1.0 / 8192.0)), FLK_TAU_MOST) * FLK_TAU_STEPS + 0.5); }

// Saturates: 65536 is beyond what any picture shows.
void addOpacity(inout Tail tail, uint tau) { tail.tau = tail.tau + tau < tail.tau ? 0xFFFFFFFFu : tail.tau + tau; }

// A fragment's sum fits a word: tau has at most 20 bits, colour 8 more than its step there.
void addColor(inout Tail tail, uint tau, vec3 color) {
  if (kTail == FLK_TAIL_KIND_NONE) return;
  uvec3 product = uvec3(clamp(color / frame.tail_range, 0.0, 1.0) * (float(tau) * kColorSteps) + 0.5);
  uvec3 carry;
  tail.low = uaddCarry(tail.low, product, carry);
  tail.high += carry;
}

// Of many fragments together, to the 24 bits of a float.
void addColorWide(inout Tail tail, uint tau, vec3 color) {
  if (kTail == FLK_TAIL_KIND_NONE) return;
  vec3 product = clamp(color / frame.tail_range, 0.0, 1.0) * (float(tau) * kColorSteps);
  uvec3 high = uvec3(product * (1.0 / 4294967296.0)), carry;
  tail.low = uaddCarry(tail.low, uvec3(product - vec3(high) * 4294967296.0), carry);
  tail.high += high + carry;
}

// color: not read where the tail has none of its own yet.
void addToTail(inout Tail tail, float alpha, vec3 color) {
  if (kTail == FLK_TAIL_KIND_LIST) {
    tail.color = alpha * color + (1.0 - alpha) * tail.color;
    tail.transmittance *= 1.0 - alpha;
  } else {
    uint tau = tauSteps(alpha);
    addOpacity(tail, tau);
    if (kTail == FLK_TAIL_KIND_MEAN) addColor(tail, tau, color);
    tail.opaque = tail.opaque || alpha >= 1.0;
  }
}

// What overflowed, behind what is in the list.
void addAggregate(inout Tail tail, float tau, vec3 color) {
  if (kTail == FLK_TAIL_KIND_LIST) {
    float through = exp2(-min(tau, 126.0));
    tail.color += tail.transmittance * (1.0 - through) * color;
    tail.transmittance *= through;
  } else {
    uint steps = uint(min(tau, 16000.0) * FLK_TAU_STEPS + 0.5);
    addOpacity(tail, steps);
    addColorWide(tail, steps, color);
  }
}

// Colour and transmittance in the end.
void closeTail(inout Tail tail) {
  if (kTail == FLK_TAIL_KIND_LIST) return;
  bool none = tail.opaque || float(tail.tau) > 126.0 * FLK_TAU_STEPS;
  tail.transmittance = none ? 0.0 : exp2(-min(float(tail.tau) / FLK_TAU_STEPS, 126.0));
  if (kTail == FLK_TAIL_KIND_NONE || tail.tau == 0u) return;
  vec3 sum = vec3(tail.high) * 4294967296.0 + vec3(tail.low);
  tail.color = sum / (float(tail.tau) * kColorSteps) * frame.tail_range * (1.0 - tail.transmittance);
}

#endif
