// The scene as kernels see it: one private struct of pointers, filled from the kernel's arguments. A buffer that the
// scene does not need is a null pointer.
#include "lib/math.cl"

typedef struct {
  __global const Node* nodes;                // [nodes] the tree, root first
  __global const DeviceTriangle* triangles;  // [triangles] leaf order
  __global const uint* corners;              // [3 triangles / 2 + 1] vertex indices, leaf order, two in a word
  __global const uint* indices32;            // [3 triangles] where those take more than 16 bits; one of the two is null
  __global const float* normals;             // [3 vertices] unit, or 0: use the geometric normal
  __global const float* tangents;            // [4 vertices]
  __global const float* uv0;                 // [2 vertices]
  __global const float* uv1;                 // [2 vertices]
  __global const float* colors;              // [4 vertices] linear RGBA
  __global const DeviceMaterial* materials;  // [materials]
  __global const DeviceTexture* textures;    // [texture slots]
  __global const uint* texels;               // RGBA8, or RG16 and BA16
  __global const float* linearFromSrgb;      // [256]
  __global const DeviceLight* lights;        // [lights]
  __global const DeviceEmitter* emitters;    // [emitters] in the scene's order
  __global const float* background;          // [3 width height] equirectangular
  __global const float* sky;                 // [height + width height] chances of its texels (host/scene/sky.h)
  __global const float* bvh8Nodes;           // [64 nodes] the eight-wide tree (host/bvh/bvh8.h)
  __global const float* leaves;              // [9 triangles + 9] corners of triangles (lib/corners.cl)
  uint triangleCount;
} SceneView;

#define SCENE_PARAMS                                                                                                 \
  __global const Node *nodes, __global const DeviceTriangle *triangles, __global const uint *corners,                \
      __global const uint *indices32, __global const float *normals, __global const float *tangents,                 \
      __global const float *uv0, __global const float *uv1, __global const float *colors,                            \
      __global const DeviceMaterial *materials, __global const DeviceTexture *textures, __global const uint *texels, \
      __global const float *linearFromSrgb, __global const DeviceLight *lights,                                      \
      __global const DeviceEmitter *emitters, __global const float *backgroundMap, __global const float *sky,        \
      __global const float *bvh8Nodes, __global const float *leaves, const uint triangleCount

#define SCENE_VIEW                                                                                          \
  {                                                                                                         \
    nodes, triangles, corners, indices32, normals, tangents, uv0, uv1, colors, materials, textures, texels, \
        linearFromSrgb, lights, emitters, backgroundMap, sky, bvh8Nodes, leaves, triangleCount              \
  }
