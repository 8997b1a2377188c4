; check: exit 1
; error 22102 at 3:22
#MILLCONT CALC [ID=1 ID=2]
M30
