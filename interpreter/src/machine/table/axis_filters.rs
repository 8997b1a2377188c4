//! Axis lists: standard and HSC filters, FIR filter, filter of the additional interface.

use super::param::{Number, Param, Switch, Whole, parameters};
use super::raw::{Bound, Raw};
use super::row::axis;
use kontur_filters::fir::FirConfig;

/// Prototypes (P-AXIS-00153).
const PROTOTYPES: &[(&str, u32)] =
    &[("CRIT_DAMPING", 1), ("BUTTERWORTH", 2), ("BESSEL", 3), ("HSC", 5)];

/// Filter types (P-AXIS-00204, P-AXIS-00738); `HSC_NOVIB` is kontur's word for 12.
const FILTER_TYPES: &[(&str, u32)] = &[
    ("LOWPASS", 1),
    ("HIGHPASS", 2),
    ("BANDPASS", 3),
    ("BANDSTOP", 4),
    ("ALLPASS", 5),
    ("PT1", 6),
    ("HSC_SINE", 7),
    ("HSC_MEAN", 8),
    ("HSC_GAUSS", 9),
    ("PT2", 10),
    ("TIME_DELAY", 11),
    ("HSC_NOVIB", 12),
];

parameters! {
    axis("P-AXIS-00067", "filter[i].fg_f0", Raw::Real64, "corner frequency of LOWPASS (start of the stop band) and HIGHPASS (start of the pass band), centre frequency of BANDPASS and BANDSTOP, first natural frequency of HSC NoVib")
        .range(Bound::At(0.0), Bound::Text("below 0.5 / cycle")).default(30.0).unit("Hz", "Hz").at_setup().source("TF5200 axis filters"), as FREQUENCY: Number;
    axis("P-AXIS-00080", "filter[i].guete", Raw::Real64, "Q = centre frequency / bandwidth, for BANDPASS and BANDSTOP only: the -3 dB edges are exactly fg_f0 / guete apart at any cycle time, unlike those of Improved Position Control, which keep the Q of the continuous filter")
        .range(Bound::At(1.0), Bound::At(10.0)).default(1.0).at_setup().source("TF5200 axis filters"), as QUALITY: Number;
    axis("P-AXIS-00140", "filter[i].order", Raw::Uns32, "filter order, 0 = off")
        .range(Bound::At(0.0), Bound::Text("6 (LOWPASS, HIGHPASS, ALLPASS), 3 (BANDPASS, BANDSTOP), 1 (PT1), 2 (PT2), 200 (HSC); TIME_DELAY: any order above 0 switches the filter on")).default(0.0).at_setup().source("TF5200 axis filters"), as ORDER: Whole;
    axis("P-AXIS-00153", "filter[i].prototype", Raw::Names(PROTOTYPES), "CRIT_DAMPING 1, BUTTERWORTH 2, BESSEL 3, HSC 5")
        .default(1.0).at_setup().source("TF5200 axis filters"), as PROTOTYPE: Whole;
    axis("P-AXIS-00164", "filter[i].share_percent", Raw::Real64, "share of the signal that passes the filter")
        .range(Bound::At(0.0), Bound::At(100.0)).default(100.0).unit("%", "%").at_setup().source("TF5200 axis filters"), as SHARE: Number;
    axis("P-AXIS-00204", "filter[i].type", Raw::Names(FILTER_TYPES), "1 LOWPASS 2 HIGHPASS 3 BANDPASS 4 BANDSTOP 5 ALLPASS 6 PT1 8 HSC mean 10 PT2 11 TIME_DELAY 12 HSC NoVib; 7, 9 reserved")
        .range(Bound::At(1.0), Bound::At(12.0)).default(1.0).at_setup().source("TF5200 axis filters"), as TYPE: Whole;
    axis("P-AXIS-00319", "filter[i].enable", Raw::Boolean, "switches a standard filter; active only with order > 0; no effect for HSC")
        .default(0.0).source("TF5200 axis filters"), as ENABLE: Switch;
    axis("P-AXIS-00351", "kenngr.filter_position_window", Raw::Real64, "the filter is settled when input and output differ by less")
        .range(Bound::At(0.01), Bound::None).default(0.4).unit("0.1um", "0.0001deg"), as SETTLED_WINDOW: Number;
    axis("P-AXIS-00357", "filter[i].time_constant", Raw::Uns32, "time constant (PT1, PT2), delay (TIME_DELAY), or HSC order as time, used when the order is 0")
        .range(Bound::Text("one cycle (PT1, PT2, HSC), 0 (TIME_DELAY)"), Bound::Text("below 6 cycles (TIME_DELAY), 200 cycles (HSC)")).default(10000.0).unit("us", "us").at_setup().source("TF5200 axis filters"), as TIME: Whole;
    axis("P-AXIS-00573", "filter_fir.enable", Raw::Boolean, "FIR filter on")
        .default(0.0).source("TF5200 FIR filter"), as FIR_ENABLE: Switch;
    axis("P-AXIS-00585", "filter_fir.fcut", Raw::Real64, "cut-off frequency, windowed sinc only (FCUT)")
        .range(Bound::At(FirConfig::MIN_FREQ_HZ), Bound::None).default(30.0).unit("Hz", "Hz").at_setup().source("TF5200 FIR filter"), as FIR_FREQUENCY: Number;
    axis("P-AXIS-00586", "filter_fir.type", Raw::Uns32, "0 none 1 moving average 2 Gauss 3 windowed sinc 4 delay")
        .range(Bound::At(0.0), Bound::At(4.0)).default(0.0).at_setup().source("TF5200 FIR filter"), as FIR_TYPE: Whole;
    axis("P-AXIS-00587", "filter_fir.order", Raw::Uns32, "order, 0 = off")
        .range(Bound::At(0.0), Bound::At(200.0)).default(0.0).at_setup().source("TF5200 FIR filter"), as FIR_ORDER: Whole;
    axis("P-AXIS-00590", "filter_fir.share", Raw::Uns32, "degree of effect (SHARE)")
        .range(Bound::At(0.0), Bound::At(100.0)).default(100.0).unit("%", "%").at_setup().source("TF5200 FIR filter"), as FIR_SHARE: Number;
    axis("P-AXIS-00591", "filter_fir.order_time", Raw::Uns32, "order as time (ORDER_TIME)")
        .range(Bound::Text("one cycle"), Bound::Text("200 cycles (100 for the delay)")).default(0.0).unit("us", "us").at_setup().source("TF5200 FIR filter"), as FIR_TIME: Whole;
    axis("P-AXIS-00593", "filter_fir.quality", Raw::Real64, "width of the Gauss kernel (QUALITY)")
        .range(Bound::Beyond(0.0), Bound::At(1.0)).default(1.0).at_setup().source("TF5200 FIR filter"), as FIR_QUALITY: Number;
    axis("P-AXIS-00735", "lr_param.add_interface.filter[i].enable", Raw::Boolean, "switches the filter of the additional interface")
        .default(0.0).source("TF5200 axis filters"), as ADDITIONAL_ENABLE: Switch;
    axis("P-AXIS-00736", "lr_param.add_interface.filter[i].order", Raw::Uns32, "order of the filter of the additional interface")
        .range(Bound::At(0.0), Bound::Text("6 (LOWPASS, HIGHPASS, ALLPASS), 3 (BANDPASS, BANDSTOP); PT1, PT2, TIME_DELAY: any order above 0 switches the filter on")).default(2.0).at_setup().source("TF5200 axis filters"), as ADDITIONAL_ORDER: Whole;
    axis("P-AXIS-00737", "lr_param.add_interface.filter[i].prototype", Raw::Names(PROTOTYPES), "prototype of the filter of the additional interface")
        .default(1.0).axes("T").at_setup().source("TF5200 axis filters"), as ADDITIONAL_PROTOTYPE: Whole;
    axis("P-AXIS-00738", "lr_param.add_interface.filter[i].type", Raw::Names(FILTER_TYPES), "type of the filter of the additional interface")
        .default(10.0).at_setup().source("TF5200 axis filters"), as ADDITIONAL_TYPE: Whole;
    axis("P-AXIS-00739", "lr_param.add_interface.filter[i].fg_f0", Raw::Real64, "corner or centre frequency of the filter of the additional interface")
        .range(Bound::Beyond(0.0), Bound::Text("below 0.5 / cycle")).default(30.0).unit("Hz", "Hz").at_setup().source("TF5200 axis filters"), as ADDITIONAL_FREQUENCY: Number;
    axis("P-AXIS-00740", "lr_param.add_interface.filter[i].guete", Raw::Real64, "Q of the filter of the additional interface")
        .range(Bound::At(1.0), Bound::At(10.0)).default(1.0).at_setup().source("TF5200 axis filters"), as ADDITIONAL_QUALITY: Number;
    axis("P-AXIS-00741", "lr_param.add_interface.filter[i].share_percent", Raw::Real64, "signal share of the filter of the additional interface")
        .range(Bound::At(0.0), Bound::At(100.0)).default(100.0).unit("%", "%").axes("T").at_setup().source("TF5200 axis filters"), as ADDITIONAL_SHARE: Number;
    axis("P-AXIS-00742", "lr_param.add_interface.filter[i].time_constant", Raw::Uns32, "time constant or delay of the filter of the additional interface")
        .range(Bound::Text("one cycle (PT1, PT2), 0 (TIME_DELAY)"), Bound::Text("below 6 cycles (TIME_DELAY)")).default(0.0).unit("us", "us").at_setup().source("TF5200 axis filters"), as ADDITIONAL_TIME: Whole;
    axis("", "lr_param.add_interface.enable", Raw::Boolean, "switches the additional interface (used in the examples)")
        .source("TF5200 axis filters"), as ADDITIONAL_INTERFACE: Switch;
}

/// The parameters of one filter.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FilterParameters {
    pub(in crate::machine) enable: Param<Switch>,
    pub(in crate::machine) kind: Param<Whole>,
    /// Of a FIR filter, which has none, its type.
    pub(in crate::machine) prototype: Param<Whole>,
    pub(in crate::machine) order: Param<Whole>,
    pub(in crate::machine) time: Param<Whole>,
    pub(in crate::machine) frequency: Param<Number>,
    pub(in crate::machine) quality: Param<Number>,
    pub(in crate::machine) share: Param<Number>,
}

/// A standard filter, or the HSC filter.
pub(in crate::machine) const fn standard(index: u32) -> FilterParameters {
    FilterParameters {
        enable: ENABLE.at(index),
        kind: TYPE.at(index),
        prototype: PROTOTYPE.at(index),
        order: ORDER.at(index),
        time: TIME.at(index),
        frequency: FREQUENCY.at(index),
        quality: QUALITY.at(index),
        share: SHARE.at(index),
    }
}

/// The FIR filter.
pub(in crate::machine) const FIR_FILTER: FilterParameters = FilterParameters {
    enable: FIR_ENABLE,
    kind: FIR_TYPE,
    prototype: FIR_TYPE,
    order: FIR_ORDER,
    time: FIR_TIME,
    frequency: FIR_FREQUENCY,
    quality: FIR_QUALITY,
    share: FIR_SHARE,
};

/// The filter of the additional interface.
pub(in crate::machine) const ADDITIONAL_FILTER: FilterParameters = FilterParameters {
    enable: ADDITIONAL_ENABLE,
    kind: ADDITIONAL_TYPE,
    prototype: ADDITIONAL_PROTOTYPE,
    order: ADDITIONAL_ORDER,
    time: ADDITIONAL_TIME,
    frequency: ADDITIONAL_FREQUENCY,
    quality: ADDITIONAL_QUALITY,
    share: ADDITIONAL_SHARE,
};
