; check: exit 1
; page 249263499 form of messages, an unknown G function
; error 20131 at 4:24
N030 G91 X10 Y200 F100 G1234 G1
M30
