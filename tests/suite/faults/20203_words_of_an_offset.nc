; check --set channel.multi_dimension_in_block=1 --set channel.multi_axes_in_block=1: exit 1
; error 20203 at 3:8
G92 X1 X2
G01 X1 F100
M30
