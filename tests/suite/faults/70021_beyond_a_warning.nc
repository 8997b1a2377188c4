; run --set channel.soft_limit_warning_axes=1: exit 1
; warning 21897 at 4:11
; error 70021 at 4:1
G01 F6000 X501
M30
