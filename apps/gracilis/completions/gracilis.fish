# Completion for fish: the program says what may stand there ('gracilis complete LINE').
complete -c gracilis -f -a '(gracilis complete (commandline -cp | string collect) 2>/dev/null)'
