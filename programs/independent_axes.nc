; Z lifts alone while the path continues (N30), then the path waits for it (N60); N70 moves X alone and the next block
; begins when it has arrived.
%INDEPENDENT_AXES
N10 G90 G00 X0 Y0 Z0
N20 Z[INDP_ASYN G90 G01 FEED=1200 POS=20 SLOPE_TYPE=SIN2]
N30 G01 X50 F6000
N40 Y30
N50 X0
N60 #WAIT INDP [Z]
N70 X[INDP_SYN G91 G01 TIME=0.5 POS=10]
N80 G01 Y0
N90 M30
