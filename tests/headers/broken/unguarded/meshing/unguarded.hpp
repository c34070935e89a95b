// A header that cannot be included twice.
namespace hemoflux::meshing {
struct Unguarded {};
}  // namespace hemoflux::meshing
