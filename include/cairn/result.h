#pragma once
// What can fail returns a Result or a Status: the value, or an Error that says what, where and what
// would be right. Cairn throws nothing, prints nothing and never ends the process.

#include <string>
#include <utility>
#include <variant>

namespace cairn {

enum class ErrorCode {
    InvalidId,     ///< the id names nothing, or something that is gone
    NotFinite,     ///< a NaN or an infinity
    OutOfRange,    ///< a finite number that makes no sense there
    NotSupported,  ///< sound, but this version cannot do it
};

struct Error {
    ErrorCode code = ErrorCode::OutOfRange;
    /// One line: the offending argument, what was found, what is allowed.
    std::string message;
};

/// A value of type T, or an Error. `*result` on an error gives a value-initialised T (a null id,
/// say), never undefined behaviour.
template <class T>
class Result {
public:
    Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
    Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

    bool ok() const { return state_.index() == 0; }
    explicit operator bool() const { return ok(); }

    const T& value() const& {
        static const T nothing{};
        return ok() ? *std::get_if<0>(&state_) : nothing;
    }
    T value() && { return ok() ? std::move(*std::get_if<0>(&state_)) : T{}; }
    const T& operator*() const& { return value(); }
    T operator*() && { return std::move(*this).value(); }
    const T* operator->() const { return &value(); }

    /// The error; with an empty message where there is none.
    const Error& error() const {
        static const Error none{ErrorCode::OutOfRange, {}};
        return ok() ? none : *std::get_if<1>(&state_);
    }

private:
    std::variant<T, Error> state_;
};

struct Done {};
/// Done, or an Error.
using Status = Result<Done>;

}  // namespace cairn
