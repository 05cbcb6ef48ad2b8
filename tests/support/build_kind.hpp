#pragma once

namespace nda::support {

/// Whether an address or thread sanitizer watches this build.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kIsSanitized = true;
#elif defined(__has_feature)
inline constexpr bool kIsSanitized =
    __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
inline constexpr bool kIsSanitized = false;
#endif

/// What promises about time may be multiplied with: they are made of optimised code alone.
#if defined(NDEBUG)
inline constexpr double kSlowdown = kIsSanitized ? 10 : 1;
#else
inline constexpr double kSlowdown = 20;
#endif

}  // namespace nda::support
