import js from '@eslint/js';
import jsxA11y from 'eslint-plugin-jsx-a11y';
import reactHooks from 'eslint-plugin-react-hooks';
import tseslint from 'typescript-eslint';

const tests = ['**/*.test.{ts,tsx}', 'vitest.setup.ts', 'harness/**'];

/** Folders of src, lowest first: each may import itself and those before it. */
const layers = [
  'generated',
  'model',
  'api',
  'i18n',
  'store',
  'commands',
  'ui',
  'workspace',
  'features',
  'frame',
];
const viewLibraries =
  '^(react|react-dom|react-i18next|zustand|@xyflow|@mantine|@tabler|@react-three|three)(/|$)';

/** One rule a layer: an import by alias or by `../` may not reach a higher layer. */
const layerRules = layers.map((layer, height) => {
  const above = layers.slice(height + 1).join('|');
  const patterns = [];
  if (above) {
    patterns.push({
      regex: `^(@/|(\\.\\./)+)(${above}|App)(/|$)`,
      message: `src/${layer} may only import lower layers (${layers.slice(0, height + 1).join(', ')}).`,
    });
  }
  if (layer === 'model') {
    patterns.push({
      regex: viewLibraries,
      message: 'src/model is plain TypeScript: trees, rules and edits know no user interface.',
    });
  }
  return {
    files: [`src/${layer}/**/*.{ts,tsx}`],
    rules: { 'no-restricted-imports': ['error', { patterns }] },
  };
});

export default tseslint.config(
  { ignores: ['dist', 'coverage', 'node_modules', 'src/generated', '*.config.js'] },
  js.configs.recommended,
  ...tseslint.configs.strict,
  jsxA11y.flatConfigs.strict,
  reactHooks.configs.flat.recommended,
  {
    files: ['**/*.{ts,tsx}'],
    languageOptions: { parserOptions: { ecmaFeatures: { jsx: true } } },
    rules: {
      'no-restricted-exports': [
        'error',
        { restrictDefaultExports: { direct: true, named: true, defaultFrom: true, namedFrom: true } },
      ],
      'no-console': 'error',
      eqeqeq: 'error',
      'max-lines': ['error', { max: 400, skipBlankLines: true, skipComments: true }],
      '@typescript-eslint/consistent-type-imports': 'error',
      '@typescript-eslint/no-unused-vars': ['error', { argsIgnorePattern: '^_', varsIgnorePattern: '^_' }],
      // Deleting a key is how a Record drops an entry.
      '@typescript-eslint/no-dynamic-delete': 'off',
    },
  },
  ...layerRules,
  {
    files: ['vite.config.ts', 'harness/vite.config.ts'],
    rules: { 'no-restricted-exports': 'off' },
  },
  {
    files: tests,
    rules: {
      '@typescript-eslint/no-non-null-assertion': 'off',
      'max-lines': 'off',
      'no-restricted-imports': 'off',
    },
  },
);
