; run: exit 0
; end X13 Y7 Z0
; passes X10 Y5
; passes X10 Y7
(the blocks of a control area are its contour: the relative ways after it begin where the axes were)
N10 G01 X10 Y5 F3000
N20 #CONTROL AREA BEGIN [ID=4 WORK POLY MIN_EXCUR=-5 MAX_EXCUR=5]
N30 G90 X-50 Y-50
N40 X50
N50 Y50
N60 X-50
N70 Y-50
N80 #CONTROL AREA END
N90 #CONTROL AREA ON [ID=4]
N100 G91 Y2
N110 X3
N120 #CONTROL AREA OFF
N130 M30
