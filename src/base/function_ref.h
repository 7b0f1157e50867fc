#pragma once
// A callable that somebody else keeps: two pointers, no allocation, one indirect call.
//
// As a parameter it takes any callable, temporaries too. Whoever stores one must see to it that the
// callable outlives it.

#include <memory>
#include <type_traits>
#include <utility>

namespace cairn {

template <class Signature>
class FunctionRef;

template <class Return, class... Arguments>
class FunctionRef<Return(Arguments...)> {
public:
    // Not for itself: those are copies.
    template <class Callable, class = std::enable_if_t<
                                  !std::is_same_v<std::remove_cvref_t<Callable>, FunctionRef> &&
                                  std::is_invocable_r_v<Return, Callable&, Arguments...>>>
    FunctionRef(Callable&& callable)
        : object_(const_cast<void*>(static_cast<const void*>(std::addressof(callable)))),
          call_([](void* object, Arguments... arguments) -> Return {
              using Target = std::remove_reference_t<Callable>;
              return (*static_cast<Target*>(object))(std::forward<Arguments>(arguments)...);
          }) {}

    Return operator()(Arguments... arguments) const {
        return call_(object_, std::forward<Arguments>(arguments)...);
    }

    // The two halves, for whoever must keep them apart.
    using Call = Return (*)(void*, Arguments...);
    void* object() const { return object_; }
    Call call() const { return call_; }

private:
    void* object_;
    Call call_;
};

}  // namespace cairn
