#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace rbc {

// Vectors that grow double their room, and then half of it may stay empty for good. These leave a
// sixteenth empty, for lists that are made now and then, of about the same size each time. One that
// changes in each step would grow in many of them.

template <typename Value> void reserve_tightly(std::vector<Value> &values, std::size_t size)
{
  if (size > values.capacity()) values.reserve(size + size / 16);
}

/// With half as much room again, for small lists whose length changes each time.
template <typename Value> void reserve_loosely(std::vector<Value> &values, std::size_t size)
{
  if (size > values.capacity()) values.reserve(size + size / 2);
}

template <typename Value> void resize_tightly(std::vector<Value> &values, std::size_t size)
{
  reserve_tightly(values, size);
  values.resize(size);
}

template <typename Value> void push_back_tightly(std::vector<Value> &values, Value value)
{
  constexpr std::size_t least = 64;
  if (values.size() == values.capacity())
    values.reserve(least + values.size() + values.size() / 16);
  values.push_back(std::move(value));
}

}    // namespace rbc
