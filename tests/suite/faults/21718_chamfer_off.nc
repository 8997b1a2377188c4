; check --set channel.disable_chamfers_roundings=1: exit 1
; error 21718 at 4:1
G01 F1000 X10
G301 I1
Y10
M30
