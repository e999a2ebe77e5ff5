/** Processor time of a call, seconds; unlike elapsed time it hardly depends on other programs. */
export function processorSeconds(work: () => unknown): number {
  const before = process.cpuUsage();
  work();
  const { user, system } = process.cpuUsage(before);
  return (user + system) / 1e6;
}
