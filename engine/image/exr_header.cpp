#include "engine/image/exr_header.h"

#include <OpenEXR/openexr.h>

#include <algorithm>
#include <cstring>

#include "engine/base/errors.h"

namespace aleph {

namespace {

struct HeaderReading {
    const ByteView* bytes = nullptr;
    std::string fault;  ///< the first one
};

HeaderReading& reading_of(exr_const_context_t context) {
    void* data = nullptr;
    exr_get_user_data(context, &data);
    return *static_cast<HeaderReading*>(data);
}

void keep_fault(exr_const_context_t context, exr_result_t /*code*/, const char* text) {
    std::string& fault = reading_of(context).fault;
    if (fault.empty()) fault = text;
}

std::int64_t size_of(exr_const_context_t /*context*/, void* data) {
    return std::ssize(*static_cast<HeaderReading*>(data)->bytes);
}

std::int64_t read_bytes(exr_const_context_t /*context*/, void* data, void* to, std::uint64_t count, std::uint64_t from,
                        exr_stream_error_func_ptr_t /*report*/) {
    const ByteView bytes = *static_cast<HeaderReading*>(data)->bytes;
    const ByteView left = bytes.subspan(std::min<std::uint64_t>(from, bytes.size()));
    const std::size_t read = std::min<std::uint64_t>(count, left.size());
    std::memcpy(to, left.data(), read);
    return static_cast<std::int64_t>(read);
}

}  // namespace

void check_exr_header(const std::string& name, const ByteView* bytes) {
    HeaderReading reading{bytes, {}};
    exr_context_initializer_t how = EXR_DEFAULT_CONTEXT_INITIALIZER;
    how.error_handler_fn = keep_fault;
    how.user_data = &reading;
    if (bytes != nullptr) {
        how.read_fn = read_bytes;
        how.size_fn = size_of;
    }
    exr_context_t context = nullptr;
    const exr_result_t result = exr_start_read(&context, name.c_str(), &how);
    exr_finish(&context);
    if (result == EXR_ERR_SUCCESS) return;
    const std::string reason = reading.fault.empty() ? exr_get_default_error_message(result) : reading.fault;
    throw InputError(printable(name, 400), "", "the header is damaged: " + printable(reason, 400));
}

}  // namespace aleph
