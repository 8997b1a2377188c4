; run: exit 1
; error 21413 at 3:51
#MACHINE DATA [AX=X AXPARAM="getriebe[0].kv 3000" WAIT]
M30
