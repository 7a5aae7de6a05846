// libheif and libzip, which few files need: loaded by the first call of one of these functions.
#include <libheif/heif.h>
#include <zip.h>

#include "core/files/forward.hpp"

DIBHR_FORWARD(heif, 0, heif_context_alloc)
DIBHR_FORWARD(heif, 1, heif_context_free)
DIBHR_FORWARD(heif, 2, heif_context_get_primary_image_handle)
DIBHR_FORWARD(heif, 3, heif_context_read_from_file)
DIBHR_FORWARD(heif, 5, heif_decode_image)
DIBHR_FORWARD(heif, 1, heif_depth_representation_info_free)
DIBHR_FORWARD(heif, 0, heif_get_version)
DIBHR_FORWARD(heif, 2, heif_image_get_bits_per_pixel_range)
DIBHR_FORWARD(heif, 2, heif_image_get_height)
DIBHR_FORWARD(heif, 3, heif_image_get_plane_readonly)
DIBHR_FORWARD(heif, 2, heif_image_get_width)
DIBHR_FORWARD(heif, 3, heif_image_handle_get_depth_image_handle)
DIBHR_FORWARD(heif, 3, heif_image_handle_get_depth_image_representation_info)
DIBHR_FORWARD(heif, 1, heif_image_handle_get_height)
DIBHR_FORWARD(heif, 3, heif_image_handle_get_list_of_depth_image_IDs)
DIBHR_FORWARD(heif, 1, heif_image_handle_get_width)
DIBHR_FORWARD(heif, 1, heif_image_handle_release)
DIBHR_FORWARD(heif, 1, heif_image_release)

DIBHR_FORWARD(zip, 1, zip_discard)
DIBHR_FORWARD(zip, 1, zip_fclose)
DIBHR_FORWARD(zip, 3, zip_fopen_index)
DIBHR_FORWARD(zip, 3, zip_fread)
DIBHR_FORWARD(zip, 3, zip_fseek)
DIBHR_FORWARD(zip, 3, zip_get_name)
DIBHR_FORWARD(zip, 2, zip_get_num_entries)
DIBHR_FORWARD(zip, 0, zip_libzip_version)
DIBHR_FORWARD(zip, 3, zip_open)
DIBHR_FORWARD(zip, 4, zip_stat)
