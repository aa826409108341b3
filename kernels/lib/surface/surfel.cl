// The surfel of a hit: what shading needs to know of the surface, evaluated from vertices, material and textures.
// Conventions: host/reference/README.md.
#include "lib/surface/clearcoat.cl"
#include "lib/surface/dispersion.cl"
#include "lib/surface/footprint.cl"
#include "lib/surface/layers.cl"
#include "lib/surface/material.cl"

typedef struct {
  Real3 position;   // world, m
  Real3 n_g;        // unit geometric normal, turned to the viewer
  Real3 n;          // unit shading normal, turned likewise
  Real3 baseColor;  // linear
  Real alpha;       // coverage a
  Real metallic;
  Real roughness;
  Real transmission;
  Real3 specularF0;  // dielectric reflectance at normal incidence, and at grazing incidence
  Real specularF90;
  Real3 emission;  // W/(m² sr), already 0 on a side that does not emit
  Real ior;
  Real3 extent;  // blend of the corners' sizes, axis by axis: what rounding errors of the position are measured by; m
  Mask front;
  Natural flags;  // MATERIAL_…
  Real3 sigma_a;
#if HAS(CLEARCOAT)
  Coat coat;
#endif
#if HAS(SHEEN)
  Sheen sheen;
#endif
#if HAS(IRIDESCENCE)
  ThinFilm film;
#endif
#if HAS(ANISOTROPY)
  Real3 grain;   // unit, across n: the direction along which facets are rougher; 0: there is none
  Real stretch;  // by how much, in [0, 1]
#endif
#if HAS(DISPERSION)
  Real halfSpread;  // from the index of green to those of red and blue; 0: they are one
#endif
#if HAS(DIFFUSE_TRANSMISSION)
  Real diffuseTransmission;  // the share of Lambert's part that leaves on the other side
  Real3 diffuseTransmissionColor;
#endif
#if HAS(TERMINATOR)
  Mask curved;       // the normals mean another surface than the triangle's plane
  Real3 lift;        // from the position to that surface, m
  Real3 liftBehind;  // the same from the other side; known with DIFFUSE_TRANSMISSION
#endif
#ifdef TEXTURE_FOOTPRINTS
  Real bend;  // half the divergence of the vertex normals, seen from the viewer's side, 1/m
#endif
} Surfel;

INLINE Real3 blend(const TrianglePoint* at, Real3 a, Real3 b, Real3 c) {
  return add3(add3(scale3(at->b0, a), scale3(at->b1, b)), scale3(at->b2, c));
}

INLINE Real3 fma3(Real s, Real3 v, Real3 plus) {
  return real3(fma(s, v.x, plus.x), fma(s, v.y, plus.y), fma(s, v.z, plus.z));
}

/// Barycentrics of the hits at distance t of the rays o + t d, found again from where those points lie beside the
/// first corner: a search's own are off by the rounding of distances to the ray's origin, which a texture shows on a
/// far or slanted triangle. Solved once for (b1, b2) and once more for what they leave over; every difference keeps
/// what it lost. An error of t is along d, and changes nothing. Clamped to the triangle; `found` where it is seen
/// from its edge.
INLINE Barycentrics refinedBarycentrics(Real3 p0, Real3 p1, Real3 p2, Real3 o, Real3 d, Real t, Barycentrics found) {
  const Real3 e1 = sub3(p1, p0), e2 = sub3(p2, p0);
  const Real3 from = sub3(o, p0), along = scale3(t, d), beside = add3(from, along);
  const Real3 besideLow = add3(add3(sumError3(o, minus3(p0), from), fma3(t, d, minus3(along))),
                               sumError3(from, along, beside));
  const Real3 across1 = cross3(e2, d), across2 = cross3(d, e1);
  const Real inverse = 1.0f / dot3(e1, across1);
  const Real free1 = dot3(beside, across1) * inverse, free2 = dot3(beside, across2) * inverse;
  const Mask seen = isfinite(free1) & isfinite(free2);
  Barycentrics at;
  const Real b1 = clampUnit(free1), room = 1.0f - b1, upper = free2 < room ? free2 : room;
  const Real b2 = free2 > 0.0f ? upper : (Real)(0.0f);
  const Real3 part1 = scale3(b1, e1), part2 = scale3(b2, e2);
  const Real3 rest1 = sub3(beside, part1), rest2 = sub3(rest1, part2);
  const Real3 left = add3(sumError3(beside, minus3(part1), rest1), sumError3(rest1, minus3(part2), rest2));
  const Real3 lost1 = add3(fma3(b1, e1, minus3(part1)), scale3(b1, sumError3(p1, minus3(p0), e1)));
  const Real3 lost2 = add3(fma3(b2, e2, minus3(part2)), scale3(b2, sumError3(p2, minus3(p0), e2)));
  const Real3 rest = add3(rest2, add3(besideLow, sub3(sub3(left, lost1), lost2)));
  const Mask inside = seen & (b1 == free1) & (b2 == free2);
  at.b0 = seen ? 1.0f - b1 - b2 : found.b0;
  at.b1 = seen ? b1 : found.b1;
  at.b2 = seen ? b2 : found.b2;
  at.low1 = inside ? dot3(rest, across1) * inverse : (Real)(0.0f);
  at.low2 = inside ? dot3(rest, across2) * inverse : (Real)(0.0f);
  return at;
}

#if HAS(VERTEX_NORMALS)
/// Normals of a triangle's corners.
typedef struct {
  Real3 a, b, c;
  Mask missing;  // some corner has none
} CornerNormals;

INLINE CornerNormals cornerNormals(const SceneView* scene, const TrianglePoint* at) {
  CornerNormals n;
  n.a = gather3(scene->normals, at->corner[0] * 3u);
  n.b = gather3(scene->normals, at->corner[1] * 3u);
  n.c = gather3(scene->normals, at->corner[2] * 3u);
  n.missing = (dot3(n.a, n.a) == 0.0f) | (dot3(n.b, n.b) == 0.0f) | (dot3(n.c, n.c) == 0.0f);
  return n;
}

/// Interpolated vertex normal, or n_g where a corner has none or the sum is useless.
INLINE Real3 vertexNormalAt(const TrianglePoint* at, const CornerNormals* corners, Real3 n_g) {
  const Real3 n = normalize3(blend(at, corners->a, corners->b, corners->c));
  return choose3(corners->missing, n_g, choose3(isFinite3(n), n, n_g));
}
#endif

#if HAS(TERMINATOR) && HAS(VERTEX_NORMALS)
/// From p towards the plane through a corner across its normal, where that lies before p.
INLINE Real3 liftTo(Real3 corner, Real3 n, Real3 p) {
  const Real height = dot3(sub3(corner, p), n);
  return scale3(height > 0.0f ? height : (Real)(0.0f), n);
}

/// To the curved surface from p, on the side of the normals (1) or on the other (-1).
INLINE Real3 liftOnSide(const TrianglePoint* at, const CornerNormals* corners, Real side, Real3 p) {
  return blend(at, liftTo(at->p0, scale3(side, corners->a), p), liftTo(at->p1, scale3(side, corners->b), p),
               liftTo(at->p2, scale3(side, corners->c), p));
}

/// The curved surface that the corners' normals mean bulges over a flat triangle, which would throw a shadow on it:
/// from there shadow rays start (Hanika, "Hacking the Shadow Terminator", Ray Tracing Gems II, 2021). Only where a
/// normal is off the plane's by as much as shows, and none by so much that it means an edge
/// (host/scene/coarse_normals.h). n_g: not turned to the viewer yet.
INLINE void liftSurfel(const TrianglePoint* at, const CornerNormals* corners, Real3 n_g, Surfel* s) {
  const Real a = dot3(corners->a, n_g), b = dot3(corners->b, n_g), c = dot3(corners->c, n_g);
  const Real ab = a < b ? a : b, least = ab < c ? ab : c;
  s->curved = !corners->missing & (least < COARSE_COSINE) & (least > EDGE_COSINE);
  const Real side = s->front ? (Real)(1.0f) : (Real)(-1.0f);
  s->lift = choose3(s->curved, liftOnSide(at, corners, side, s->position), same3((float3)(0.0f)));
#if HAS(DIFFUSE_TRANSMISSION)
  s->liftBehind = choose3(s->curved, liftOnSide(at, corners, -side, s->position), same3((float3)(0.0f)));
#endif
}
#endif

#ifdef TEXTURE_FOOTPRINTS
/// The footprint in texture coordinates: a ray moved sideways by a vector meets the triangle's plane where b1 and b2
/// are other by its products with two vectors across the ray.
INLINE void addFootprint(const SceneView* scene, const TrianglePoint* at, Real3 d, const Footprint* footprint, Uv* uv) {
  const Real3 e1 = sub3(at->p1, at->p0), e2 = sub3(at->p2, at->p0);
  const Real3 across1 = cross3(e2, d), across2 = cross3(d, e1);
  const Real scale = footprint->width / dot3(e1, across1);
  Real3 axis[2];
  Real b1[2], b2[2];
  basisAbout(d, axis, axis + 1);
  for (uint n = 0; n < 2; ++n) b1[n] = scale * dot3(axis[n], across1), b2[n] = scale * dot3(axis[n], across2);
#if HAS(UV0)
  if (scene->uv0) acrossUvSet(scene->uv0, at->corner, b1, b2, 0, uv);
#endif
#if HAS(UV1)
  if (scene->uv1) acrossUvSet(scene->uv1, at->corner, b1, b2, 1, uv);
#endif
  uv->probes = footprint->probes;
}

#if HAS(VERTEX_NORMALS) && HAS(IMPULSES)
/// Half the divergence over the triangle of the interpolated vertex normals, 1/m; 0 where a corner has none.
INLINE Real bendOf(const TrianglePoint* at, const CornerNormals* n, Real3 n_g) {
  const Real3 e1 = sub3(at->p1, at->p0), e2 = sub3(at->p2, at->p0);
  const Real3 across1 = cross3(e2, n_g), across2 = cross3(n_g, e1);
  const Real turn = dot3(sub3(n->b, n->a), across1) + dot3(sub3(n->c, n->a), across2);
  const Real bend = 0.5f * turn / dot3(e1, across1);
  return !n->missing & isfinite(bend) ? bend : (Real)(0.0f);
}
#endif
#endif

/// Tangent and bitangent at a point, unit and across n; not finite where the mesh has none.
typedef struct {
  Real3 tangent, bitangent;
} TangentFrame;

INLINE TangentFrame tangentFrame(const SceneView* scene, const TrianglePoint* at, Real3 n) {
  TangentFrame frame;
  const Real3 along = blend(at, gather3(scene->tangents, at->corner[0] * 4u),
                            gather3(scene->tangents, at->corner[1] * 4u), gather3(scene->tangents, at->corner[2] * 4u));
  frame.tangent = normalize3(sub3(along, scale3(dot3(n, along), n)));
  frame.bitangent = scale3(gather(scene->tangents + 3, at->corner[0] * 4u), cross3(n, frame.tangent));
  return frame;
}

#if HAS(TEXTURES) && (HAS(NORMAL_TEXTURE) || HAS(CLEARCOAT))
/// n tilted by a normal map (`slots` of it for each lane); n itself where there is none or no tangent to lay it along.
INLINE Real3 mappedNormal(const SceneView* scene, const TrianglePoint* at, Real3 n, Natural slots, Real scale) {
  const Mask mapped = slots < 0x80000000u;
  if (!scene->tangents || !some(mapped)) return n;
  const TangentFrame frame = tangentFrame(scene, at, n);
  const Rgba texel = textureAt(scene, at, slots, normalTextureEncoding);
  const Real x = (texel.c[0] * 2.0f - 1.0f) * scale, y = (texel.c[1] * 2.0f - 1.0f) * scale,
             z = texel.c[2] * 2.0f - 1.0f;
  const Real3 tilted = normalize3(add3(add3(scale3(x, frame.tangent), scale3(y, frame.bitangent)), scale3(z, n)));
  return choose3(mapped & isFinite3(frame.tangent) & isFinite3(tilted), tilted, n);
}
#endif

INLINE Real normalReflectance(Real ior) {
  const Real ratio = (ior - 1.0f) / (ior + 1.0f);
  return ior == 0.0f ? (Real)(1.0f) : ratio * ratio;
}

/// Reflectance at normal and grazing incidence of the dielectric part (KHR_materials_ior, KHR_materials_specular).
INLINE void specularReflectance(const SceneView* scene, const TrianglePoint* at, Surfel* s) {
  const Real r0 = normalReflectance(s->ior);
  s->specularF0 = real3(r0, r0, r0);
#if HAS(DISPERSION)
  s->specularF0.x = normalReflectance(channelIndex(s->ior, s->halfSpread, 0));
  s->specularF0.z = normalReflectance(channelIndex(s->ior, s->halfSpread, 2));
#endif
  s->specularF90 = (Real)(1.0f);
#if HAS(SPECULAR_EXTENSION)
  Real strength = MATERIAL(at, specular);
  Real3 tint = MATERIAL3(at, specularColor);
#if HAS(TEXTURES)
  const Rgba specular = TEXTURE_AT(scene, at, specularTexture);
  strength *= specular.c[3];
  const Rgba specularColor = TEXTURE_AT(scene, at, specularColorTexture);
  tint = mul3(tint, real3(specularColor.c[0], specularColor.c[1], specularColor.c[2]));
#endif
  const Real3 f0 = mul3(s->specularF0, tint), one = same3((float3)(1.0f));
  s->specularF0 = scale3(strength,
                         real3(f0.x < 1.0f ? f0.x : one.x, f0.y < 1.0f ? f0.y : one.y, f0.z < 1.0f ? f0.z : one.z));
  s->specularF90 = strength;
#endif
}

/// What the material says at the hit, textures included.
INLINE void materialAt(const SceneView* scene, const TrianglePoint* at, Surfel* s) {
  s->flags = MATERIAL_BITS(at, flags);
  const Rgba base = baseColorAt(scene, at);
  s->baseColor = real3(base.c[0], base.c[1], base.c[2]);
  s->alpha = (Real)(1.0f);
#if HAS(ALPHA_BLEND)
  s->alpha = (s->flags & MATERIAL_BLEND) != 0 ? clampUnit(base.c[3]) : s->alpha;
#endif
  metallicRoughnessAt(scene, at, &s->metallic, &s->roughness);
  s->transmission = transmissionAt(scene, at);
  s->ior = MATERIAL(at, ior);
  s->sigma_a = MATERIAL3(at, sigma_a);
#if HAS(DISPERSION)
  s->halfSpread = halfSpreadAt(at, s->flags, s->transmission, s->ior);
#endif
  specularReflectance(scene, at, s);
#if HAS(DIFFUSE_TRANSMISSION)
  s->diffuseTransmission = diffuseTransmissionAt(scene, at, &s->diffuseTransmissionColor);
#endif
#if HAS(SHEEN)
  s->sheen = sheenAt(scene, at);
#endif
#if HAS(IRIDESCENCE)
  s->film = filmAt(scene, at);
#endif
  s->emission = same3((float3)(0.0f));
#if HAS(EMISSION)
  Real3 emission = MATERIAL3(at, emission);
#if HAS(TEXTURES)
  const Rgba glow = TEXTURE_AT(scene, at, emissionTexture);
  emission = mul3(emission, real3(glow.c[0], glow.c[1], glow.c[2]));
#endif
  s->emission = choose3(s->front | ((s->flags & MATERIAL_DOUBLE_SIDED) != 0), emission, s->emission);
#endif
}

/// A shading normal of the front side, as the viewer along d sees it.
INLINE Real3 turnedToViewer(const Surfel* s, Real3 n, Real3 d) {
  n = choose3(s->front, n, minus3(n));
  return choose3(dot3(n, d) < 0.0f, n, s->n_g);
}

#if HAS(CLEARCOAT)
/// The coat, which dims what the surface gives off; there is none on the inside of a solid. n: of the front side,
/// before the surface's own normal map.
INLINE void addCoat(const SceneView* scene, const TrianglePoint* at, Real3 n, Real3 d, Surfel* s) {
  Real share = MATERIAL(at, clearcoat), roughness = MATERIAL(at, clearcoatRoughness);
#if HAS(TEXTURES)
  const Rgba covered = TEXTURE_AT(scene, at, clearcoatTexture),
             rough = TEXTURE_AT(scene, at, clearcoatRoughnessTexture);
  share *= covered.c[0];
  roughness *= rough.c[1];
  n = mappedNormal(scene, at, n, MATERIAL_BITS(at, clearcoatNormalTexture), MATERIAL(at, clearcoatNormalScale));
#endif
  const Mask outside = s->front | ((s->flags & MATERIAL_VOLUME) == 0);
  share = outside ? share : (Real)(0.0f);
  s->coat = coatOf(turnedToViewer(s, n, d), d, share, roughness);
  s->emission = scale3(1.0f - s->coat.reflectance, s->emission);
}
#endif

#if HAS(ANISOTROPY)
/// The direction of the facets; n: of the front side, before the normal map.
INLINE void addGrain(const SceneView* scene, const TrianglePoint* at, Real3 n, Surfel* s) {
  s->grain = same3((float3)(0.0f));
  s->stretch = (Real)(0.0f);
#if HAS(VERTEX_NORMALS) || HAS(VERTEX_COLORS) || HAS(TEXTURES)  // else no corner is known, nor has any a tangent
  Real strength = MATERIAL(at, anisotropy);
  if (!scene->tangents || !some(strength > 0.0f)) return;
  Real x = (Real)(1.0f), y = (Real)(0.0f);
#if HAS(TEXTURES)
  const Mask textured = MATERIAL_BITS(at, anisotropyTexture) < 0x80000000u;
  const Rgba texel = TEXTURE_AT(scene, at, anisotropyTexture);
  x = textured ? texel.c[0] * 2.0f - 1.0f : x;
  y = textured ? texel.c[1] * 2.0f - 1.0f : y;
  strength *= texel.c[2];
#endif
  Real cosine, sine;
  aroundCircle(MATERIAL(at, anisotropyRotation) * (0.5f / PI), &cosine, &sine);
  const TangentFrame frame = tangentFrame(scene, at, n);
  const Real3 turned = add3(scale3(x * cosine - y * sine, frame.tangent),
                            scale3(x * sine + y * cosine, frame.bitangent));
  const Real3 grain = normalize3(sub3(turned, scale3(dot3(s->n, turned), s->n)));
  const Mask directed = isFinite3(grain) & (strength > 0.0f);
  strength = clampUnit(strength);
  s->grain = choose3(directed, grain, s->grain);
  s->stretch = directed ? strength * strength : s->stretch;
#endif
}
#endif

/// The surfel at the hit (triangle, t, b1, b2) of the ray o + t d.
INLINE Surfel surfelAt(const SceneView* scene, Natural triangleIndex, Real3 o, Real3 d, Real t, Real b1, Real b2,
                       Footprint footprint) {
  Surfel s;
  const Barycentrics found = barycentrics(b1, b2);
  TrianglePoint at = trianglePoint(scene, triangleIndex, &found);
  const Real3 p0 = at.p0, p1 = at.p1, p2 = at.p2;
#if HAS(TEXTURES)
  // For texture coordinates alone: what no texture shows keeps its bits whether this is compiled or not.
  const Barycentrics refined = refinedBarycentrics(p0, p1, p2, o, d, t, found);
  at.uv = uvAt(scene, at.corner, &refined);
#ifdef TEXTURE_FOOTPRINTS
  addFootprint(scene, &at, d, &footprint, &at.uv);
#endif
#else
  at.uv = uvAt(scene, at.corner, &found);
#endif
  s.position = blend(&at, p0, p1, p2);
  s.extent = blend(&at, real3(fabs(p0.x), fabs(p0.y), fabs(p0.z)), real3(fabs(p1.x), fabs(p1.y), fabs(p1.z)),
                   real3(fabs(p2.x), fabs(p2.y), fabs(p2.z)));
  const Real3 n_g = normalize3(cross3(sub3(p1, p0), sub3(p2, p0)));
  s.front = dot3(n_g, d) < 0.0f;
  Real3 n = n_g;
#if HAS(TERMINATOR)
  s.curved = (Mask)(0);
  s.lift = s.liftBehind = same3((float3)(0.0f));
#endif
#ifdef TEXTURE_FOOTPRINTS
  s.bend = (Real)(0.0f);
#endif
#if HAS(VERTEX_NORMALS)
  if (scene->normals) {
    const CornerNormals corners = cornerNormals(scene, &at);
    n = vertexNormalAt(&at, &corners, n_g);
#if defined(TEXTURE_FOOTPRINTS) && HAS(IMPULSES)
    const Real bend = bendOf(&at, &corners, n_g);
    s.bend = s.front ? bend : -bend;
#endif
#if HAS(TERMINATOR)
    liftSurfel(&at, &corners, n_g, &s);
#endif
  }
#endif
#if HAS(CLEARCOAT) || HAS(ANISOTROPY)
  const Real3 unmapped = n;
#endif
#if HAS(TEXTURES) && HAS(NORMAL_TEXTURE)
  n = mappedNormal(scene, &at, n, MATERIAL_BITS(&at, normalTexture), MATERIAL(&at, normalScale));
#endif
  s.n_g = choose3(s.front, n_g, minus3(n_g));
  s.n = turnedToViewer(&s, n, d);
  materialAt(scene, &at, &s);
#if HAS(CLEARCOAT)
  addCoat(scene, &at, unmapped, d, &s);
#endif
#if HAS(ANISOTROPY)
  addGrain(scene, &at, unmapped, &s);
#endif
  return s;
}
