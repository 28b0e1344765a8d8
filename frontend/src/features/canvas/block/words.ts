/** The ends of words inside a name: `CheckObstacle`, `move_base`, `ROSTopic`, `go to`. */
const ENDS = /(?<=[\p{Ll}\d])(?=\p{Lu})|(?<=\p{Lu})(?=\p{Lu}\p{Ll})|(?<=[_\-./: ])/u;

/** Returns the words of a name, with their separators: a line may break between them. */
export const wordsOf = (name: string): string[] => name.split(ENDS);
