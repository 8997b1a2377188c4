//! Speed at outer corners that are almost tangential, where tool radius compensation inserts small arcs (G26).

use kontur_tests::{Run, run};

/// Two lines that meet at an outer corner, 30 mm long each.
fn compensated(corner: &str, drop_mm: f64, settings: &[&str]) -> Run {
    let program = format!(
        "G01 X10 Y0 F6000\nV.G.WZ_AKT.R=0.5\n{corner}\nG41\nG01 X20\nX50\nX80 Y{:.9}\nG40\nX100\nM30\n",
        -drop_mm
    );
    let run = run(&program, settings);
    assert_eq!(run.ids(), Vec::<u32>::new(), "{corner} {drop_mm}");
    run
}

/// Slowest speed of the path over the corner.
fn slowest(run: &Run) -> f64 {
    let near = run.records.iter().filter(|r| (40.0..60.0).contains(&r.axes[0].ipo));
    near.map(|r| r.path.v_mm_s).fold(f64::INFINITY, f64::min)
}

/// Rounding of coordinates turns a joint by nanometres: the arc in it is shorter than that and changes nothing.
#[test]
fn rounding_does_not_brake() {
    for settings in [&[][..], &["channel.corr_v_trans_jerk=1"]] {
        let straight = compensated("G26", 0.0, settings);
        for drop_mm in [5e-8, 1e-6, 1e-4, 1e-3] {
            let run = compensated("G26", drop_mm, settings);
            assert!(slowest(&run) > 99.99, "{drop_mm}: {}", slowest(&run));
            assert_eq!(run.records.len(), straight.records.len(), "{drop_mm}");
        }
    }
}

/// Up to 3 deg (1067243147) the path is at least as fast as over the kink of G25, beyond that as the arc permits: sqrt(a r), with the
/// acceleration of X and Y.
#[test]
fn arcs_at_small_corners_are_no_slower_than_kinks() {
    for deg in [0.5, 1.5, 2.9] {
        let drop_mm = 30.0 * libm::tan(f64::to_radians(deg));
        let (arc, kink) = (compensated("G26", drop_mm, &[]), compensated("G25", drop_mm, &[]));
        // the kink lies between two samples, one cycle of 3.5 mm/s apart
        assert!(slowest(&arc) > slowest(&kink) - 3.5, "{deg}: {}", slowest(&arc));
        assert!(arc.records.len() <= kink.records.len() + 1, "{deg}");
    }
    let arc = compensated("G26", 30.0 * libm::tan(f64::to_radians(3.1)), &[]);
    let kink = compensated("G25", 30.0 * libm::tan(f64::to_radians(2.9)), &[]);
    assert!(slowest(&arc) < slowest(&kink), "{}", slowest(&arc));
}
