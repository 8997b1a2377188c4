; run: exit 0
; end X20
; warning K-0070 at 6:21
; warning 110100 at 7:21
; warning 110150 at 8:21
#MACHINE DATA [AX=X AXPARAM="getriebe[0].multi_gain_n 0"]
#MACHINE DATA [AX=X AXPARAM="getriebe[0].slope_profil.a_beschl 0"]
#MACHINE DATA [AX=Y AXPARAM="getriebe[0].kv 0"]
G01 X10 F6000
(in force again, nothing to correct)
#MACHINE DATA [AX=X AXPARAM="getriebe[0].slope_profil.a_beschl 3500"]
X20
M30
