import { t } from '@/i18n';
import {
  createTheme,
  localStorageColorSchemeManager,
  type CSSVariablesResolver,
  type MantineColorsTuple,
} from '@mantine/core';

/** The accent in ten steps from light to dark, around `--bts-accent`. */
const indigo: MantineColorsTuple = [
  '#eef0fd',
  '#dadffa',
  '#b3bcf3',
  '#8b99ed',
  '#6a7be7',
  '#5566e4',
  '#4355d6',
  '#3647bd',
  '#2e3da4',
  '#24318a',
];

/** Mantine's dark scale, from our dark tokens: from the text colour to the deepest background. */
const dark: MantineColorsTuple = [
  '#e9ebf1',
  '#c3c9d6',
  '#a1aabd',
  '#6a7489',
  '#303644',
  '#282d38',
  '#1e222b',
  '#181b22',
  '#12141a',
  '#0e1015',
];

export const theme = createTheme({
  primaryColor: 'indigo',
  primaryShade: { light: 6, dark: 5 },
  colors: { indigo, dark },
  fontFamily: 'var(--bts-font)',
  fontFamilyMonospace: 'var(--bts-font-mono)',
  defaultRadius: 'md',
  radius: { xs: '3px', sm: '5px', md: '8px', lg: '12px', xl: '16px' },
  fontSizes: { xs: '12px', sm: '13px', md: '14px', lg: '16px', xl: '20px' },
  spacing: { xs: '4px', sm: '8px', md: '16px', lg: '24px', xl: '32px' },
  headings: { fontWeight: '650' },
  cursorType: 'pointer',
  components: {
    Notification: {
      defaultProps: {
        closeButtonProps: { 'aria-label': t('frame:close') },
        styles: { description: { color: 'var(--bts-muted)' } },
      },
    },
    // The header of a dialogue must not be announced as the banner of the page.
    ModalHeader: { defaultProps: { role: 'none' } },
    Modal: { defaultProps: { closeButtonProps: { 'aria-label': t('frame:close') } } },
    Tooltip: { defaultProps: { openDelay: 350, withArrow: true, fz: 'xs' } },
    ActionIcon: { defaultProps: { variant: 'subtle', color: 'gray' } },
    Button: { defaultProps: { size: 'sm' } },
    Menu: { defaultProps: { shadow: 'md', withinPortal: true } },
    Loader: { defaultProps: { role: 'status' } },
  },
});

/** Maps Mantine's variables to our tokens, so that each theme has a single source. */
export const cssVariablesResolver: CSSVariablesResolver = () => {
  const shared = {
    '--mantine-color-body': 'var(--bts-surface)',
    '--mantine-color-text': 'var(--bts-text)',
    '--mantine-color-dimmed': 'var(--bts-muted)',
    '--mantine-color-anchor': 'var(--bts-accent)',
    '--mantine-color-error': 'var(--bts-failure)',
    '--mantine-color-placeholder': 'var(--bts-muted)',
    '--mantine-color-default': 'var(--bts-surface)',
    '--mantine-color-default-hover': 'var(--bts-surface-2)',
    '--mantine-color-default-color': 'var(--bts-text)',
    '--mantine-color-default-border': 'var(--bts-border)',
    '--mantine-color-indigo-light': 'var(--bts-accent-soft)',
    '--mantine-color-indigo-light-hover': 'var(--bts-accent-soft-hover)',
    '--mantine-color-indigo-light-color': 'var(--bts-accent)',
    '--mantine-color-gray-light-color': 'var(--bts-muted)',
  };
  return { variables: {}, light: shared, dark: shared };
};

export const colorSchemeManager = localStorageColorSchemeManager({ key: 'bt-studio-theme' });
