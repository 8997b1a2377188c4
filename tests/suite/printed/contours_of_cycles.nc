; check: exit 1
; page 781132427 path milling, a cycle of the vendor with its contour
; error K-0019 at 7:5
; error K-0019 at 10:5
; error K-0013 at 11:21
N10 F5000
N20 #CONTOUR BEGIN [ID = 1]
N30 G01 G90 X25 Y25
N40 G01 G91 X50
N50 #CONTOUR END
N60 L CYCLE [NAME = SysMillContourPath.ecy @P1 = 0]
N70 M30
