/** Measures processor time from now on; the result gives it in seconds. Unlike elapsed time it hardly depends on others. */
export function processorTimer(): () => number {
  const before = process.cpuUsage();
  return () => {
    const { user, system } = process.cpuUsage(before);
    return (user + system) / 1e6;
  };
}

/** Processor time of a call, seconds. */
export function processorSeconds(work: () => unknown): number {
  const seconds = processorTimer();
  work();
  return seconds();
}
