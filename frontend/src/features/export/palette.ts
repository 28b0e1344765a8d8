import tokens from '@/ui/tokens.css?raw';

export type Theme = 'light' | 'dark';

/** A function that returns the value of a colour token (`--bts-<name>`) in a theme. */
export type Palette = (name: string) => string;

const DARK = "[data-mantine-color-scheme='dark'] {";

function read(block: string): Map<string, string> {
  return new Map(
    [...block.matchAll(/--bts-([\w-]+):\s*([^;]+);/g)].map(([, name = '', value = '']) => [name, value]),
  );
}

const [lightBlock = '', darkBlock = ''] = tokens.split(DARK);
const light = read(lightBlock);
const dark = read(darkBlock);

/**
 * Returns the colours of a theme, also of the theme that the page does not show, since pictures are used
 * elsewhere.
 */
export function paletteOf(theme: Theme): Palette {
  return (name) => (theme === 'dark' ? dark.get(name) : undefined) ?? light.get(name) ?? 'currentColor';
}
