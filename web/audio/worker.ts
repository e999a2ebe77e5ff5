import { serve, type TaskContext } from '../common/serve-tasks';
import { analyse, type Analysis } from './analyse';
import type { DecodedSong } from './decode';
import type { AudioRecipe } from './recipe';

const tasks = {
  /** Reports the fraction that is done, 0 to 1. */
  analyse(
    { song, recipe }: { song: DecodedSong; recipe: AudioRecipe },
    { report }: TaskContext<number>,
  ): Analysis {
    return analyse(song.channels, song.sampleRate, recipe, (fraction) => void report(fraction));
  },
};
export type AudioTasks = typeof tasks;

serve(tasks);
