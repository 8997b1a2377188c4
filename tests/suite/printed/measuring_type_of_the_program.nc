; run --set X,Y,Z.kenngr.messachse=1: exit 0
; page 15556930187 type of measuring (#MEAS MODE)
; note K-0133 at 6:5
; end X150
N10 #MEAS MODE[3]
N20 G100 X150 F5000
N100 #MEAS MODE
M30
