/** Returns a time in s as recordings have it, in whole ns: times of the session can be a little beside theirs. */
export const recordedTime = (t: number): number => Math.round(t * 1e9) / 1e9;
