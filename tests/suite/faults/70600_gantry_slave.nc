; run -m gantry --set X2.lr_param.improved_position_control.enable=1: exit 0
; warning 70600 at --set 1:1
X1 F1000
M30
