/** Seconds that the processor worked on a call; unlike the time on the wall, other programs hardly change it. */
export function processorSeconds(work: () => unknown): number {
  const before = process.cpuUsage();
  work();
  const { user, system } = process.cpuUsage(before);
  return (user + system) / 1e6;
}
