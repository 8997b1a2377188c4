; check --set channel.configuration.decoder.msg_to_default=WARNING: exit 0
; warning 22194 at 3:1
#MSG ["a"]
M30
