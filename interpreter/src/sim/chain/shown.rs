//! Requested quantities of the control in the cycles of a row.

use crate::record::{Asked, AxisColumns, Quantity};
use kontur_filters::control::axis_control::{CalmCycles, ControlOutput, Shown};

/// Columns of the control: values that are computed together are written together.
pub(super) struct ShownControl<'a> {
    positions: bool,
    control: bool,
    drive: bool,
    columns: [&'a mut [f64]; 17],
}

impl<'a> ShownControl<'a> {
    const POSITIONS: [Quantity; 5] =
        [Quantity::Reference, Quantity::Act, Quantity::Load, Quantity::Lag, Quantity::Settling];
    const CONTROL: [Quantity; 7] = [
        Quantity::Ff,
        Quantity::Cmd,
        Quantity::Vadd,
        Quantity::VaddLimited,
        Quantity::LagLimit,
        Quantity::Tcp,
        Quantity::TcpAcc,
    ];
    const DRIVE: [Quantity; 5] = [
        Quantity::CmdDrive,
        Quantity::VffDrive,
        Quantity::VaddDrive,
        Quantity::TorqueDrive,
        Quantity::TorqueNm,
    ];

    /// The columns of this number of cycles; `None` if nobody reads them.
    pub(super) fn of(columns: &'a mut AxisColumns<'_>, rows: usize) -> Option<Self> {
        let [positions, control, drive] = [
            columns.has_any(Asked::of(&Self::POSITIONS)),
            columns.has_any(Asked::of(&Self::CONTROL)),
            columns.has_any(Asked::of(&Self::DRIVE)),
        ];
        let mut all = Self::POSITIONS.into_iter().chain(Self::CONTROL).chain(Self::DRIVE);
        let all = std::array::from_fn(|_| all.next().unwrap_or(Quantity::TorqueNm));
        let columns = columns.together(all, rows)?;
        Some(Self { positions, control, drive, columns })
    }

    /// Cycle `i` of the row.
    #[inline]
    pub(super) fn put(&mut self, i: usize, cycle: &Shown<'_>) {
        if self.positions {
            let [reference, act, load, lag, settling, ..] = &mut self.columns;
            reference[i] = cycle.reference_mm;
            act[i] = cycle.act_mm;
            load[i] = cycle.load_mm;
            lag[i] = cycle.lag_mm;
            settling[i] = cycle.settling_s();
        }
        if self.control || self.drive {
            self.put_others(i, &cycle.output());
        }
    }

    /// Calm cycles, from number `first` on.
    pub(super) fn put_calm(&mut self, first: usize, cycles: &CalmCycles<'_>) {
        if self.positions {
            let [reference, act, load, lag, settling, ..] = &mut self.columns;
            let settling_s = cycles.settling_s();
            for (i, positions_mm) in (first..).zip(cycles.positions_mm()) {
                [reference[i], act[i], load[i], lag[i]] = positions_mm;
                settling[i] = settling_s;
            }
        }
        if self.control || self.drive {
            for i in 0..cycles.len() {
                self.put_others(first + i, &cycles.get(i).output());
            }
        }
    }

    /// The quantities that few traces show.
    #[inline(never)]
    fn put_others(&mut self, i: usize, out: &ControlOutput) {
        let [_, _, _, _, _, control @ .., c, f, a, t, n] = &mut self.columns;
        if self.control {
            let [ff, cmd, vadd, vadd_limited, lag_limit, tcp, tcp_acc] = control;
            ff[i] = out.feedforward.speed_mm_s + out.feedforward.additive_speed_mm_s;
            cmd[i] = out.command_mm_s;
            vadd[i] = out.additive_speed_mm_s;
            vadd_limited[i] = f64::from(u8::from(out.additive_speed_limited));
            lag_limit[i] = out.lag_limit_mm.unwrap_or(0.0);
            tcp[i] = out.tcp_mm;
            tcp_acc[i] = out.tcp_acc_mm_s2;
        }
        if self.drive {
            c[i] = out.drive.command;
            f[i] = out.drive.feedforward;
            a[i] = out.drive.additive_speed;
            t[i] = out.drive.torque;
            n[i] = out.drive.torque_n_m;
        }
    }
}
