// Arrays that grow by little and are packed in place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace chiaro {

/// Appends with capacity growing by a part of it: a 64th, as memory is part of what we promise, or
/// more where many come at once.
template <typename T>
void append(std::vector<T>& array, const T& value, std::size_t part = 64) {
    if (array.size() == array.capacity()) array.reserve(array.size() + array.size() / part + 64);
    array.push_back(value);
}

/// Removes what is not marked, in order, and gives its memory back.
template <typename T>
void keep_only(std::vector<T>& array, const std::vector<char>& kept) {
    std::size_t next = 0;
    for (std::size_t i = 0; i < kept.size(); ++i)
        if (kept[i]) array[next++] = array[i];
    array.resize(next);
    array.shrink_to_fit();
}

/// Bytes that an array holds, unused capacity included.
template <typename T>
std::size_t bytes_of(const std::vector<T>& array) {
    return array.capacity() * sizeof(T);
}

}  // namespace chiaro
