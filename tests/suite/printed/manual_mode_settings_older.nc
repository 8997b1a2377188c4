; run: exit 0
; page 15556807819 settings of an axis in manual mode, older form
; end X0 Y0
; warning K-0100 at 10:1
; warning K-0100 at 11:1
; warning K-0100 at 12:1
; warning K-0100 at 13:1
; warning K-0111 at 14:1
G202 #ACHSE[X,Y]
#SET HR [0.1, 0.2, 0.5] X
#SET TIP [1.0, 1.5, 2.0] X
#SET JOG [ [ 0.1, 1.0 ] [ 0.2, 1.5 ] [ 0.5, 2.0 ] ] X
#SET OFFSET [ -5, 5 ] X
G201 #ACHSE [X]
G202 #ACHSE[X]
M30
