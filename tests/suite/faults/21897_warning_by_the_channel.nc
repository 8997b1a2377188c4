; run --set channel.soft_limit_warning_axes=1: exit 0
; warning 21897 at 3:11
G01 F6000 X500.05
M30
