; run --set channel.multi_dimension_in_block=1 --set channel.multi_axes_in_block=1: exit 0
; page 149346955 channel parameters, P-CHAN-00148
; passes X10 Y11 Z20
; passes X2 Y21 Z50
; passes X10 Y25 Z80
; end X5 Y45 Z125
N10 G00 G90 X0 Y0 Z0
N20 G90 X10 G91 Y10 Z20 Y1
N30 G91 X10 Y10 G90 X2 G91 Z30
N40 G90 X10 Y20 G91 Z30 Y5
N50 G91 Z15 Y20 G90 X5 G91 Z30
N60 M30
