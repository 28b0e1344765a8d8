/** Built-in types that are one block in several variants: the palette offers the first, the inspector the others. */
export const VARIANTS = {
  Switch: ['Switch2', 'Switch3', 'Switch4', 'Switch5', 'Switch6'],
  Loop: ['LoopInt', 'LoopDouble', 'LoopString', 'LoopBool'],
} as const;

export type VariantName = keyof typeof VARIANTS;

const NAMES = Object.keys(VARIANTS) as VariantName[];

/** Returns the block of which a type is a variant; null if it is none. */
export const variantOf = (type: string): VariantName | null =>
  NAMES.find((name) => (VARIANTS[name] as readonly string[]).includes(type)) ?? null;

/** Returns whether the palette leaves a type out, since another variant stands for it. */
export function isOtherVariant(type: string): boolean {
  const name = variantOf(type);
  return name !== null && VARIANTS[name][0] !== type;
}
