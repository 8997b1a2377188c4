//! What follows from axes that join the channel or leave it.

use crate::exec::decoder::Decoder;

/// The feed group of the channel list; if it has none, the main axes.
pub(super) fn default_feed_group(decoder: &mut Decoder) {
    let channel = &decoder.machine.channel;
    let members = if channel.feed.lists_axes {
        channel.feed.axes.clone()
    } else {
        let is_main = |axis| decoder.geometry.coordinates.main_index(axis).is_some();
        (0..decoder.machine.axes.len()).map(is_main).collect()
    };
    decoder.motion.limits.set_feed_axes(members, false);
}

/// Called after a change of names and main axes.
pub(super) fn exchanged(decoder: &mut Decoder) {
    if !decoder.motion.limits.feed_axes_named() {
        default_feed_group(decoder);
    }
}

/// The G136 weights of exchanged axes return to 100 %.
pub(super) fn full_feedforward(decoder: &mut Decoder, axes: &[usize]) {
    let weights = &mut decoder.motion.feedforward.weight_ratios;
    if axes.iter().any(|axis| weights[*axis] < 1.0) {
        for axis in axes {
            weights[*axis] = 1.0;
        }
        decoder.contour.event(decoder.motion.feedforward.event());
    }
}

/// As above, for every axis of the machine.
pub(super) fn full_feedforward_of_all(decoder: &mut Decoder) {
    let all: Vec<usize> = (0..decoder.machine.axes.len()).collect();
    full_feedforward(decoder, &all);
}

pub(super) fn release(decoder: &mut Decoder, axis: usize) {
    decoder.names.rename(axis, None);
    if let Some(main) = decoder.geometry.coordinates.main_index(axis) {
        decoder.geometry.coordinates.set_main_axis(main, None);
    }
}
