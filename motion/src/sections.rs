//! Sections of a block with separate speeds: which of them to join.

use std::ops::Range;

/// Joins neighbouring sections, each with its end in mm from the start of the block and its permitted speed in mm/s.
///
/// Neighbours stay together as long as their lowest speed costs at most the share `worth` more time. Each group is
/// compared with the time of its sections at their separate speeds, so that a speed that changes gradually does not end
/// up in one group.
pub(crate) fn joined(
    sections: impl IntoIterator<Item = (f64, f64)>,
    worth: f64,
) -> Vec<Range<usize>> {
    let mut groups: Vec<Group> = Vec::new();
    let mut from_mm = 0.0;
    for (i, (end_mm, v_mm_s)) in sections.into_iter().enumerate() {
        let least_s = (end_mm - from_mm) / v_mm_s;
        let mut group = Group { range: i..i + 1, from_mm, v_mm_s, least_s };
        from_mm = end_mm;
        while let Some(before) = groups.last() {
            let both = Group {
                range: before.range.start..group.range.end,
                from_mm: before.from_mm,
                v_mm_s: before.v_mm_s.min(group.v_mm_s),
                least_s: before.least_s + group.least_s,
            };
            if (end_mm - both.from_mm) / both.v_mm_s > (1.0 + worth) * both.least_s {
                break;
            }
            group = both;
            groups.pop();
        }
        groups.push(group);
    }
    groups.into_iter().map(|group| group.range).collect()
}

struct Group {
    range: Range<usize>,
    from_mm: f64,
    /// The lowest speed of its sections.
    v_mm_s: f64,
    /// Time of the sections at their separate speeds.
    least_s: f64,
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const WORTH: f64 = 0.1;

    /// The time of groups, and of the sections one by one.
    fn seconds(sections: &[(f64, f64)], groups: &[Range<usize>]) -> Vec<(f64, f64)> {
        let starts: Vec<f64> =
            std::iter::once(0.0).chain(sections.iter().map(|section| section.0)).collect();
        groups
            .iter()
            .map(|range| {
                let slowest = sections[range.clone()].iter().map(|s| s.1).fold(f64::MAX, f64::min);
                let separate = range.clone().map(|i| (sections[i].0 - starts[i]) / sections[i].1);
                ((starts[range.end] - starts[range.start]) / slowest, separate.sum())
            })
            .collect()
    }

    proptest! {
        /// No group costs more than its share, and groups cover the block without gaps.
        #[test]
        fn groups_cost_little(
            sections in proptest::collection::vec((0.001..10.0_f64, 1.0..100.0_f64), 1..60)
        ) {
            let mut end = 0.0;
            let sections: Vec<(f64, f64)> = sections
                .into_iter()
                .map(|(length, speed)| { end += length; (end, speed) })
                .collect();
            let groups = joined(sections.iter().copied(), WORTH);
            prop_assert_eq!(groups[0].start, 0);
            prop_assert_eq!(groups[groups.len() - 1].end, sections.len());
            prop_assert!(groups.windows(2).all(|pair| pair[0].end == pair[1].start));
            for (together, separate) in seconds(&sections, &groups) {
                prop_assert!(together <= (1.0 + WORTH) * separate * (1.0 + 1e-9));
            }
        }
    }

    /// A speed that rises by 3 % from section to section is divided although no two neighbours differ much.
    #[test]
    fn a_gradual_change_is_divided() {
        let sections: Vec<(f64, f64)> =
            (1..=60).map(|i| (f64::from(i), libm::pow(1.03, f64::from(i)))).collect();
        assert!(joined(sections, WORTH).len() > 5);
    }

    #[test]
    fn equal_speeds_stay_together() {
        assert_eq!(joined([(1.0, 5.0), (2.0, 5.0), (9.0, 5.0)], WORTH).len(), 1);
    }
}
