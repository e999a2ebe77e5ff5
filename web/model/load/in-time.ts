/** The result of work. @throws `late` when it has not come after so many milliseconds; the work itself goes on */
export async function inTime<T>(
  work: Promise<T>,
  ms: number,
  late: () => Error = () => new Error(`nothing for ${ms / 1000} seconds`),
): Promise<T> {
  let timer: ReturnType<typeof setTimeout> | undefined;
  const timeout = new Promise<never>((_, reject) => {
    timer = setTimeout(() => reject(late()), ms);
  });
  try {
    return await Promise.race([work, timeout]);
  } finally {
    clearTimeout(timer);
  }
}
