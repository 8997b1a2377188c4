; run --set channel.modal_i_j_k_for_circle=1: exit 0
; end X0 Y40
; passes X10 Y10
; passes X10 Y30
; passes X5 Y35
(I and J hold until the next ones P-CHAN-00159: half circles to the right, each above the one before)
(a radius takes their place, and they its)
G00 X0 Y0
G03 Y20 I0 J10 F2000
G03 Y40
G01 Y30
G03 Y40 R5
G01 Y20
G03 Y40 J10
M30
