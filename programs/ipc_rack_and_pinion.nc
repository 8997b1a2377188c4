; Improved Position Control on a rack-and-pinion axis, back and forth (machine rack_and_pinion). While it travels, the
; teeth shake the tool point at 53 Hz; accelerating and braking rock the column at 11 Hz. Trace columns
; X_tcp_acc_mm_s2 (acceleration of the tool point) and X_vadd_mm_s (the counter-movement of the motor).
;   N20  half a metre at 272.7 mm/s; from 0.761 s to 1.939 s at constant speed
;                        53 Hz at the tool point: 810 mm/s2 without, 365 mm/s2 with the function
;   N30  from 2.095 s: at rest; the column swings out (5 ms after the set position: the buffer of feedforward)
;                        11 Hz at the tool point: 520 mm/s2 without, 270 mm/s2 with the function
; Without the function: --set X.lr_param.improved_position_control.enable=0
%IPC_RACK_AND_PINION
N10 G71 G90 G04 0.1
N20 G01 X500 F16362
N30 G04 1.2
N40 X0
N50 G04 1.2
N60 M30
