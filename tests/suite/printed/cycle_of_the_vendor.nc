; check: exit 1
; page 535944075 calibration of a probe, a cycle of the vendor
; warning K-0114 at 5:8
; error K-0013 at 8:19
N10 T1 D1
N20 G53
N30 G00 G90 X140 Y141 Z100
N40 L CYCLE [NAME=SysCalibTouchprobe5.ecy   \
        @P3 = 200                       \
        @P4 = 300                       \
        ]
N50 M30
