// libavformat, libavcodec and libswscale, which bring a hundred libraries: loaded by the first call
// of one of these functions. libavutil is linked.
extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

#include "core/files/forward.hpp"

DIBHR_FORWARD(libav, 6, av_find_best_stream)
DIBHR_FORWARD(libav, 1, av_find_input_format)
DIBHR_FORWARD(libav, 3, av_guess_frame_rate)
DIBHR_FORWARD(libav, 3, av_index_search_timestamp)
DIBHR_FORWARD(libav, 2, av_read_frame)
DIBHR_FORWARD(libav, 4, av_seek_frame)
DIBHR_FORWARD(libav, 2, av_write_frame)
DIBHR_FORWARD(libav, 1, av_write_trailer)
DIBHR_FORWARD(libav, 0, avformat_alloc_context)
DIBHR_FORWARD(libav, 4, avformat_alloc_output_context2)
DIBHR_FORWARD(libav, 1, avformat_close_input)
DIBHR_FORWARD(libav, 2, avformat_find_stream_info)
DIBHR_FORWARD(libav, 1, avformat_free_context)
DIBHR_FORWARD(libav, 2, avformat_index_get_entry)
DIBHR_FORWARD(libav, 2, avformat_new_stream)
DIBHR_FORWARD(libav, 4, avformat_open_input)
DIBHR_FORWARD(libav, 0, avformat_version)
DIBHR_FORWARD(libav, 2, avformat_write_header)
DIBHR_FORWARD(libav, 7, avio_alloc_context)
DIBHR_FORWARD(libav, 1, avio_closep)
DIBHR_FORWARD(libav, 1, avio_context_free)
DIBHR_FORWARD(libav, 1, avio_flush)
DIBHR_FORWARD(libav, 3, avio_open)
DIBHR_FORWARD(libav, 3, avio_seek)
#if LIBAVFORMAT_VERSION_INT >= AV_VERSION_INT(60, 15, 100)
DIBHR_FORWARD(libav, 3, av_packet_side_data_get)
#else
DIBHR_FORWARD(libav, 3, av_stream_get_side_data)
#endif

DIBHR_FORWARD(libav, 0, av_packet_alloc)
DIBHR_FORWARD(libav, 1, av_packet_free)
DIBHR_FORWARD(libav, 2, av_packet_move_ref)
DIBHR_FORWARD(libav, 3, av_packet_rescale_ts)
DIBHR_FORWARD(libav, 1, av_packet_unref)
DIBHR_FORWARD(libav, 1, avcodec_alloc_context3)
DIBHR_FORWARD(libav, 1, avcodec_find_decoder)
DIBHR_FORWARD(libav, 1, avcodec_find_encoder)
DIBHR_FORWARD(libav, 1, avcodec_find_encoder_by_name)
DIBHR_FORWARD(libav, 1, avcodec_flush_buffers)
DIBHR_FORWARD(libav, 1, avcodec_free_context)
DIBHR_FORWARD(libav, 2, avcodec_get_hw_config)
DIBHR_FORWARD(libav, 1, avcodec_get_name)
DIBHR_FORWARD(libav, 3, avcodec_open2)
DIBHR_FORWARD(libav, 0, avcodec_parameters_alloc)
DIBHR_FORWARD(libav, 2, avcodec_parameters_copy)
DIBHR_FORWARD(libav, 1, avcodec_parameters_free)
DIBHR_FORWARD(libav, 2, avcodec_parameters_from_context)
DIBHR_FORWARD(libav, 2, avcodec_parameters_to_context)
DIBHR_FORWARD(libav, 2, avcodec_receive_frame)
DIBHR_FORWARD(libav, 2, avcodec_receive_packet)
DIBHR_FORWARD(libav, 2, avcodec_send_frame)
DIBHR_FORWARD(libav, 2, avcodec_send_packet)
DIBHR_FORWARD(libav, 0, avcodec_version)

DIBHR_FORWARD(libav, 1, sws_freeContext)
DIBHR_FORWARD(libav, 11, sws_getCachedContext)
DIBHR_FORWARD(libav, 1, sws_getCoefficients)
DIBHR_FORWARD(libav, 7, sws_scale)
DIBHR_FORWARD(libav, 8, sws_setColorspaceDetails)
DIBHR_FORWARD(libav, 0, swscale_version)
