// The program's memory comes from jemalloc, in huge pages where the system gives them on request. Rays read meshes,
// textures and records all over the memory, and would spend much of their time on finding pages of 4 KiB. Large blocks
// are kept like small ones, not given back at once: clearing huge pages again and again costs as much.

extern "C" {
extern const char* malloc_conf;
__attribute__((visibility("default"))) const char* malloc_conf = "thp:always,oversize_threshold:0";
}
