//! G functions: one row each, with group, meaning and whether a value is expected.
//!
//! Source: TF5200 programming manual, list of G functions; diagnosis manual for the IDs of double programming.

mod group;

use super::choice::{Compensation, Corners, FeedType, PathMode, Plane, Selection};
use crate::exec::motion::weight::Weight;
pub(in crate::exec) use group::Group;

/// Meaning of a G function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::exec) enum Act {
    Path(PathMode),
    Dwell,
    Plane(Plane),
    /// Mirrors first and second main axis.
    Mirror(bool, bool),
    /// G351.
    MirrorAxes,
    Inch(bool),
    Absolute(bool),
    FeedType(FeedType),
    /// G53 to G59.
    ZeroGroup(u32),
    /// G159.
    ZeroGroupValue,
    /// G160.
    ZeroGroupAxes,
    /// G92.
    Preset,
    /// G98 (false), G99 (true): negative and positive software limit.
    SoftwareLimits(bool),
    ExactStopOnce,
    ExactStop(bool),
    ContourOnce,
    Contour(bool),
    /// G09.
    EarlyBrakingOnce,
    /// G901 (true), G900.
    LateBraking(bool),
    Compensation(Compensation),
    /// G200 to G202: refused.
    Manual,
    /// G193.
    FeedOverPath,
    /// G293.
    FeedOverTime,
    /// G13 (true), G12.
    CornerDeceleration(bool),
    /// G11 (true), G10.
    EngagementFeed(bool),
    /// G25, G26.
    Corners(Corners),
    /// G05.
    Tangential,
    /// G138, G139, G237 to G239.
    Selection(Selection),
    CentreAbsolute(bool),
    CentreCorrection(bool),
    /// G163.
    Radius,
    /// With axis words.
    WeightOfAxes(Weight),
    /// With a value.
    WeightOfAll(Weight),
    Feedforward(bool),
    /// G136.
    FeedforwardWeights,
    /// G68.
    Rotate,
    /// G69.
    RotateOff,
    /// G115.
    LookAheadFunctions,
    /// G116 (true), G117.
    StopAtTransitions(bool),
    /// G166.
    FullOverride,
    /// G301, G302.
    Chamfer,
    Rounding,
    /// G51 (true), G52.
    Diameter(bool),
    /// G151 (true), G150.
    Spline(bool),
    /// G96 (true), G97.
    CuttingSpeed(bool),
    /// G196.
    CuttingSpeedMax,
    /// G100, G310.
    Measure,
    /// G106.
    MeasureThrough,
    /// G108 (true), G107.
    Banding(bool),
    /// G101 (true), G102.
    MeasuringOffsets(bool),
    /// G112.
    Gear,
    /// Already the behaviour of this tool.
    Nothing,
    /// No influence on set positions.
    Ignored(&'static str),
    /// The corresponding part of the motion is simulated without it, as the text states.
    Simplified(&'static str),
    /// Changes the path and is not simulated.
    Unsupported(&'static str),
}

/// A value after the number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::exec) enum ValueRule {
    Never,
    Required,
    Optional,
}

/// One row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::exec) struct Row {
    pub(in crate::exec) number: u32,
    pub(in crate::exec::block) group: Group,
    pub(in crate::exec) act: Act,
    pub(in crate::exec::block) value: ValueRule,
}

const fn g(number: u32, group: Group, act: Act) -> Row {
    Row { number, group, act, value: ValueRule::Never }
}

/// A row with a value.
const fn v(number: u32, group: Group, act: Act) -> Row {
    Row { number, group, act, value: ValueRule::Required }
}

const FEED_CHANGE: &str = "a higher feed is approached from the start of its block";
const FEED_HOLD: &str = "feedhold brakes without these weights";

/// All rows, ordered by number. G80 to G89 and G800 to G899 are subroutine calls and not in the table.
#[rustfmt::skip]
const ROWS: &[Row] = &[
    g(0, Group::Path, Act::Path(PathMode::Rapid)),
    g(1, Group::Path, Act::Path(PathMode::Linear)),
    g(2, Group::Path, Act::Path(PathMode::Clockwise)),
    g(3, Group::Path, Act::Path(PathMode::CounterClockwise)),
    Row { number: 4, group: Group::Path, act: Act::Dwell, value: ValueRule::Optional },
    g(5, Group::None, Act::Tangential),
    g(8, Group::FeedInterpolation, Act::Ignored(FEED_CHANGE)),
    g(9, Group::Deceleration, Act::EarlyBrakingOnce),
    g(10, Group::CompensationFeed, Act::EngagementFeed(false)),
    g(11, Group::CompensationFeed, Act::EngagementFeed(true)),
    g(12, Group::CornerDeceleration, Act::CornerDeceleration(false)),
    g(13, Group::CornerDeceleration, Act::CornerDeceleration(true)),
    g(17, Group::Plane, Act::Plane(Plane::Xy)),
    g(18, Group::Plane, Act::Plane(Plane::Zx)),
    g(19, Group::Plane, Act::Plane(Plane::Yz)),
    g(20, Group::Mirror, Act::Mirror(false, false)),
    g(21, Group::Mirror, Act::Mirror(true, false)),
    g(22, Group::Mirror, Act::Mirror(false, true)),
    g(23, Group::Mirror, Act::Mirror(true, true)),
    g(25, Group::CompensationTransition, Act::Corners(Corners::Straight)),
    g(26, Group::CompensationTransition, Act::Corners(Corners::Round)),
    g(33, Group::Path, Act::Path(PathMode::Thread)),
    g(40, Group::Compensation, Act::Compensation(Compensation::Off)),
    g(41, Group::Compensation, Act::Compensation(Compensation::Left)),
    g(42, Group::Compensation, Act::Compensation(Compensation::Right)),
    g(51, Group::Diameter, Act::Diameter(true)),
    g(52, Group::Diameter, Act::Diameter(false)),
    g(53, Group::ZeroOffset, Act::ZeroGroup(0)),
    g(54, Group::ZeroOffset, Act::ZeroGroup(1)),
    g(55, Group::ZeroOffset, Act::ZeroGroup(2)),
    g(56, Group::ZeroOffset, Act::ZeroGroup(3)),
    g(57, Group::ZeroOffset, Act::ZeroGroup(4)),
    g(58, Group::ZeroOffset, Act::ZeroGroup(5)),
    g(59, Group::ZeroOffset, Act::ZeroGroup(6)),
    g(60, Group::Transition, Act::ExactStopOnce),
    g(61, Group::Transition, Act::ContourOnce),
    g(63, Group::Path, Act::Path(PathMode::Tapping)),
    g(66, Group::None, Act::Simplified("blocks end within a cycle, as without it")),
    g(68, Group::Rotation, Act::Rotate),
    g(69, Group::Rotation, Act::RotateOff),
    g(70, Group::Unit, Act::Inch(true)),
    g(71, Group::Unit, Act::Inch(false)),
    g(74, Group::Path, Act::Simplified("the axes are treated as homed at their positions, without motion")),
    g(90, Group::Dimension, Act::Absolute(true)),
    g(91, Group::Dimension, Act::Absolute(false)),
    g(92, Group::None, Act::Preset),
    g(93, Group::FeedType, Act::FeedType(FeedType::Time)),
    g(94, Group::FeedType, Act::FeedType(FeedType::PerMinute)),
    g(95, Group::FeedType, Act::FeedType(FeedType::PerRevolution)),
    g(96, Group::SpindleMode, Act::CuttingSpeed(true)),
    g(97, Group::SpindleMode, Act::CuttingSpeed(false)),
    g(98, Group::None, Act::SoftwareLimits(false)),
    g(99, Group::None, Act::SoftwareLimits(true)),
    g(100, Group::Measuring, Act::Measure),
    g(101, Group::Measuring, Act::MeasuringOffsets(true)),
    g(102, Group::Measuring, Act::MeasuringOffsets(false)),
    g(106, Group::None, Act::MeasureThrough),
    g(107, Group::Measuring, Act::Banding(false)),
    g(108, Group::Measuring, Act::Banding(true)),
    g(112, Group::None, Act::Gear),
    v(115, Group::LookAhead, Act::LookAheadFunctions),
    g(116, Group::LookAhead, Act::StopAtTransitions(true)),
    g(117, Group::LookAhead, Act::StopAtTransitions(false)),
    g(127, Group::VelocityWeight, Act::WeightOfAxes(Weight::Velocity)),
    v(128, Group::VelocityWeight, Act::WeightOfAll(Weight::Velocity)),
    v(129, Group::RapidVelocityWeight, Act::WeightOfAll(Weight::RapidVelocity)),
    g(130, Group::AccelerationWeight, Act::WeightOfAxes(Weight::Acceleration)),
    v(131, Group::AccelerationWeight, Act::WeightOfAll(Weight::Acceleration)),
    g(132, Group::RampWeight, Act::WeightOfAxes(Weight::Ramp)),
    v(133, Group::RampWeight, Act::WeightOfAll(Weight::Ramp)),
    v(134, Group::RampWeight, Act::WeightOfAll(Weight::GeometricRamp)),
    g(135, Group::Feedforward, Act::Feedforward(true)),
    g(136, Group::None, Act::FeedforwardWeights),
    g(137, Group::Feedforward, Act::Feedforward(false)),
    g(138, Group::CompensationSelection, Act::Selection(Selection::Direct)),
    g(139, Group::CompensationSelection, Act::Selection(Selection::Indirect)),
    g(140, Group::Masking, Act::Nothing),
    g(141, Group::Masking, Act::Unsupported("contour masking")),
    g(150, Group::Splines, Act::Spline(false)),
    g(151, Group::Splines, Act::Spline(true)),
    v(159, Group::ZeroOffset, Act::ZeroGroupValue),
    v(160, Group::None, Act::ZeroGroupAxes),
    g(161, Group::CentreType, Act::CentreAbsolute(true)),
    g(162, Group::CentreType, Act::CentreAbsolute(false)),
    v(163, Group::None, Act::Radius),
    g(164, Group::CentreCorrection, Act::CentreCorrection(false)),
    g(165, Group::CentreCorrection, Act::CentreCorrection(true)),
    g(166, Group::FullOverride, Act::FullOverride),
    // an external override has no effect on spindles
    g(167, Group::None, Act::Nothing),
    g(193, Group::FeedInterpolation, Act::FeedOverPath),
    g(194, Group::FeedType, Act::FeedType(FeedType::ShareOfMaximum)),
    g(196, Group::SpindleMode, Act::CuttingSpeedMax),
    g(200, Group::Manual, Act::Manual),
    g(201, Group::Manual, Act::Manual),
    g(202, Group::Manual, Act::Manual),
    g(230, Group::RapidAccelerationWeight, Act::WeightOfAxes(Weight::RapidAcceleration)),
    v(231, Group::RapidAccelerationWeight, Act::WeightOfAll(Weight::RapidAcceleration)),
    v(233, Group::RampWeight, Act::WeightOfAll(Weight::RapidRamp)),
    g(236, Group::CompensationSelection, Act::Unsupported("selection of tool radius compensation on the path")),
    g(237, Group::CompensationSelection, Act::Selection(Selection::Perpendicular)),
    g(238, Group::CompensationSelection, Act::Selection(Selection::InsideCorner)),
    g(239, Group::CompensationSelection, Act::Selection(Selection::WithoutBlock)),
    g(260, Group::Transition, Act::Contour(false)),
    g(261, Group::Transition, Act::Contour(true)),
    g(293, Group::FeedInterpolation, Act::FeedOverTime),
    g(301, Group::Insertion, Act::Chamfer),
    g(302, Group::Insertion, Act::Rounding),
    g(303, Group::Path, Act::Path(PathMode::ArcInSpace)),
    g(310, Group::Measuring, Act::Measure),
    g(331, Group::Path, Act::Path(PathMode::TapIn)),
    g(332, Group::Path, Act::Path(PathMode::TapBack)),
    g(333, Group::HoldAccelerationWeight, Act::Simplified(FEED_HOLD)),
    v(334, Group::HoldAccelerationWeight, Act::Simplified(FEED_HOLD)),
    g(338, Group::RampWeight, Act::Simplified(FEED_HOLD)),
    v(339, Group::RampWeight, Act::Simplified(FEED_HOLD)),
    g(351, Group::Mirror, Act::MirrorAxes),
    g(359, Group::Transition, Act::ExactStop(false)),
    g(360, Group::Transition, Act::ExactStop(true)),
    g(900, Group::Deceleration, Act::LateBraking(false)),
    g(901, Group::Deceleration, Act::LateBraking(true)),
];

/// Highest number of the data format; above it 20107. Unassigned numbers below it are 20131.
///
/// Assumption: four digits; the documents give 20131 for G1234, and 20107 for a number with five.
pub(in crate::exec) const NUMBER_MAX: u32 = 9999;

/// The row of a number.
pub(in crate::exec) fn row(number: u32) -> Option<&'static Row> {
    ROWS.binary_search_by_key(&number, |r| r.number).ok().map(|i| &ROWS[i])
}

/// The reason why two functions of different groups cannot share a block.
///
/// Source: TF5200 programming manual, feed interpolation (G193/G293): not in the block of G09. The diagnosis manual gives
/// 20109 for G08 beside them; no ID is printed for G09.
pub(in crate::exec) fn exclude(one: &Row, other: &Row) -> Option<&'static str> {
    let over = |row: &Row| matches!(row.act, Act::FeedOverPath | Act::FeedOverTime);
    let brakes = |row: &Row| row.act == Act::EarlyBrakingOnce;
    ((over(one) && brakes(other)) || (over(other) && brakes(one)))
        .then_some("both set how the feed is approached")
}

/// Whether it is an implicit subroutine call.
pub(in crate::exec) fn is_cycle_call(number: u32) -> bool {
    (80..=89).contains(&number) || (800..=839).contains(&number)
}

/// Whether the axis words of the block are arguments of this function instead of targets.
pub(in crate::exec) fn takes_axes(row: &Row) -> bool {
    matches!(
        row.act,
        Act::Dwell
            | Act::Preset
            | Act::SoftwareLimits(_)
            | Act::ZeroGroupAxes
            | Act::WeightOfAxes(_)
            | Act::FeedforwardWeights
            | Act::MirrorAxes
            | Act::Rotate
            | Act::MeasuringOffsets(_)
            | Act::StopAtTransitions(_)
    ) || matches!(row.number, 74 | 107 | 108 | 112 | 200..=202 | 333 | 338)
}

/// The effect of a G function that is refused.
pub(crate) fn unsupported(number: u32) -> Option<&'static str> {
    ROWS.iter().filter(|row| row.number == number).find_map(|row| match row.act {
        Act::Unsupported(what) => Some(what),
        _ => None,
    })
}

#[cfg(test)]
mod tests {
    use super::{Act, ROWS};

    #[test]
    fn rows_are_ordered_and_unique() {
        assert!(ROWS.windows(2).all(|w| w[0].number < w[1].number));
    }

    #[test]
    fn every_function_that_runs_is_explained() {
        for row in ROWS.iter().filter(|row| !matches!(row.act, Act::Unsupported(_))) {
            let name = format!("G{:02}", row.number);
            assert!(crate::explain::explain(&name).is_ok(), "{name}");
        }
    }
}
