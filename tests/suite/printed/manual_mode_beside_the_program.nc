; run: exit 0
; page 15556788363 manual mode beside the program (G201, G202)
; passes X100 Y100
; end X100 Y200
; warning K-0111 at 7:1
G00 X100 Y100
G201 #ACHSE[X]
P1 = 0
$WHILE P1 == 0
P1 = 1
$ENDWHILE
G202
G01 Y200 F500
M30
