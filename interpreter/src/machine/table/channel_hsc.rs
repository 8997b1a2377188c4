//! Channel lists: `hsc.*`, the settings of `#HSC` at program start.

use super::param::parameters;
use super::raw::{Bound, Raw};
use super::row::chan;

parameters! {
    chan("P-CHAN-00122", "hsc.bspline.path_deviation", Raw::Real64, "PATH_DEV of #HSC [BSPLINE] at program start; 0: not monitored")
        .range(Bound::At(0.0), Bound::None).default(2000.0).unit("0.1um", "0.1um")
        .source("TF5200 channel parameters 149366923"), as PATH_DEVIATION: Number;
    chan("P-CHAN-00123", "hsc.bspline.track_deviation", Raw::Real64, "TRACK_DEV of #HSC [BSPLINE] at program start; 0: not monitored")
        .range(Bound::At(0.0), Bound::None).default(50_000.0).unit("0.1um", "0.0001deg")
        .source("TF5200 channel parameters 149368459"), as TRACK_DEVIATION: Number;
    chan("P-CHAN-00124", "hsc.bspline.max_path_length", Raw::Real64, "MAX_PATH_LENGTH of #HSC [BSPLINE] at program start; 0: unlimited")
        .range(Bound::At(0.0), Bound::None).default(0.0).unit("0.1um", "0.1um")
        .source("TF5200 channel parameters 149369995"), as MAX_LENGTH: Number;
    chan("P-CHAN-00125", "hsc.bspline.max_angle", Raw::Real64, "MAX_ANGLE of #HSC [BSPLINE] at program start; 0: unlimited")
        .range(Bound::At(0.0), Bound::None).default(0.0).unit("0.0001deg", "0.0001deg")
        .source("TF5200 channel parameters 149371531"), as MAX_ANGLE: Number;
    chan("P-CHAN-00127", "hsc.bspline.merge_window", Raw::Uns32, "number of blocks from which MERGE merges them; no effect here, blocks are not merged")
        .default(5.0).source("TF5200 channel parameters 149374603");
    chan("P-CHAN-00128", "hsc.bspline.auto_off_g00", Raw::Boolean, "AUTO_OFF_G00 of #HSC [BSPLINE] at program start")
        .default(0.0).source("TF5200 channel parameters 149376139"), as OFF_AT_RAPID: Switch;
    chan("P-CHAN-00129", "hsc.bspline.auto_off_path", Raw::Boolean, "AUTO_OFF_PATH of #HSC [BSPLINE] at program start")
        .default(0.0).source("TF5200 channel parameters 149377675"), as OFF_AT_PATH_DEVIATION: Switch;
    chan("P-CHAN-00130", "hsc.bspline.auto_off_track", Raw::Boolean, "AUTO_OFF_TRACK of #HSC [BSPLINE] at program start")
        .default(0.0).source("TF5200 channel parameters 149379211"), as OFF_AT_TRACK_DEVIATION: Switch;
    chan("P-CHAN-00131", "hsc.bspline.limit_corner_dist", Raw::Real64, "smallest distance of a B-spline from a corner, relative to the block; not simulated")
        .range(Bound::At(0.0), Bound::At(250.0)).default(200.0).unit("0.1%", "0.1%")
        .source("TF5200 channel parameters 149380747");
    chan("P-CHAN-00132", "hsc.gen.linear_segmentation", Raw::Boolean, "1: lines are divided before a spline is fitted; not simulated")
        .default(0.0).source("TF5200 channel parameters 149388427");
    chan("P-CHAN-00134", "hsc.gen.linear_continuous_split", Raw::Boolean, "P-CHAN-00132 divides lines into pieces of the same length; not simulated")
        .default(0.0).source("TF5200 channel parameters 149391499");
    chan("P-CHAN-00135", "hsc.gen.linear_split_length", Raw::Uns32, "length of the pieces of P-CHAN-00132; not simulated")
        .default(1000.0).unit("0.1um", "0.1um").source("TF5200 channel parameters 149393035");
    chan("P-CHAN-00136", "hsc.gen.circular_secant_error", Raw::Boolean, "what P-CHAN-00138 states: 0 the secant error, 1 the length of the pieces of an arc; not simulated")
        .default(0.0).source("TF5200 channel parameters 149394571");
    chan("P-CHAN-00137", "hsc.gen.circular_segmentation", Raw::Boolean, "1: arcs are divided under #HSC as P-CHAN-00136 and P-CHAN-00138 state; not simulated")
        .default(0.0).source("TF5200 channel parameters 149396107");
    chan("P-CHAN-00138", "hsc.gen.circular_param", Raw::Uns32, "secant error or length of the pieces of an arc under #HSC (P-CHAN-00136); not simulated")
        .default(50.0).unit("0.1um", "0.1um").source("TF5200 channel parameters 149397643");
    chan("P-CHAN-00217", "hsc.gen.on_delay_output_one_block", Raw::Boolean, "1: the first motion after #HSC ON is not part of the spline; not simulated")
        .default(0.0).source("TF5200 channel parameters 149406859");
    chan("P-CHAN-00240", "hsc.bspline.fgroup", Raw::Boolean, "1: the feed on a B-spline is that of the feed group (#FGROUP), 0: that of the main axes; with 0, feed axes other than the main axes are refused")
        .default(0.0).source("TF5200 channel parameters 149383819"), as FEED_GROUP: Switch;
    chan("P-CHAN-00405", "hsc.gen.max_track_ratio", Raw::Real64, "ratio of the ways of other axes and main axes at which a spline ends; not simulated")
        .range(Bound::Beyond(0.0), Bound::None).default(100.0).source("TF5200 channel parameters 149408395");
    chan("P-CHAN-00421", "hsc.bspline.auto_off_g60", Raw::Boolean, "1: a spline ends at G60 and G360; no effect here, it always does")
        .default(0.0).source("TF5200 channel parameters 308290059");
}
