// Objects that JavaScript holds by numbers. A number is never given twice, so that a freed object is always recognised.
#pragma once

#include "chasles/base/invalid_input.h"

#include <cstdint>
#include <map>
#include <string>

namespace chasles::javascript {

template <typename Object>
class Handles {
public:
    explicit Handles(const char* name) : name_(name) {}

    std::int32_t add(Object object) {
        objects_.emplace(next_, std::move(object));
        return next_++;
    }
    /// Throws InvalidInput for the handle of no object.
    Object& get(double handle) {
        const auto found = handle >= 1 && handle < next_ ? objects_.find(static_cast<std::int32_t>(handle)) : objects_.end();
        if (found == objects_.end())
            throw InvalidInput(std::string(name_) + ": has been freed");
        return found->second;
    }
    /// Without effect for the handle of no object.
    void free(std::int32_t handle) { objects_.erase(handle); }
    [[nodiscard]] std::size_t size() const { return objects_.size(); }

private:
    const char* name_;
    std::map<std::int32_t, Object> objects_;
    std::int32_t next_ = 1;
};

} // namespace chasles::javascript
