// Which formats of pictures does this build read, besides PNG and JPEG?
#pragma once

namespace gnomon::detail {

/// True where OpenImageIO is built in and has a reader of WebP.
[[nodiscard]] bool reads_webp() noexcept;

}  // namespace gnomon::detail
