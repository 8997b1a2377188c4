; check: exit 1
; error 20802 at 6:1
V.G.WZ_AKT.R=1
G41 X10 F100
X20
#MCS ON
M30
