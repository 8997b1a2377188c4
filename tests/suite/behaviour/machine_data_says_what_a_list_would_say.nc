; run: exit 0
; end X10
; warning K-0033 at 8:21
; warning K-0075 at 11:21
; warning K-0112 at 12:21
#MACHINE DATA [AX=X AXPARAM="filter[0].fg_f0 600"]
#MACHINE DATA [AX=X AXPARAM="filter[0].order 2"]
#MACHINE DATA [AX=X AXPARAM="filter[0].enable 1"]
(nothing new about the filter)
#MACHINE DATA [AX=X AXPARAM="filter[0].guete 2"]
#MACHINE DATA [AX=Y AXPARAM="filter[0].enable 1"]
#MACHINE DATA [AX=Y AXPARAM="filter[0].order 1"]
G01 X10 F3000
M30
