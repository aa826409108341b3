// Giving an array's memory back before its scope ends.
#pragma once

namespace whittle {

/// Empties a vector and frees what it holds. (`v = {}` assigns an empty list: it keeps the memory.)
template <class Vector>
void freeArray(Vector& v) {
  Vector().swap(v);
}

}  // namespace whittle
