// How the compute rasterisers share their work: see passes/walk.glsl.
#ifndef FORELOCK_SHARED_WALK_H
#define FORELOCK_SHARED_WALK_H

#define FLK_WALK_LANES 128     // of a group
#define FLK_WALK_SEGMENTS 16u  // that it takes

#endif
