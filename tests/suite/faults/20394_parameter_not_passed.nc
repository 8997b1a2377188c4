; check --set channel.create_cycle_param_on_read=0: exit 1
; error 20394 at called/unpassed.nc 1:2
L CYCLE [NAME=called/unpassed.nc]
M30
