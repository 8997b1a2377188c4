; check: exit 1
; error 21381 at 4:1
L CYCLE [NAME=called/cycle.cyc MODAL_MOVE @P1=5]
L CYCLE [NAME=called/cycle.cyc @P1=5]
M30
