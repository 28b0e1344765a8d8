export * from './become';
export { edit, type Recipe } from './core';
export * from './fields';
export * from './levels';
export * from './structure';
export * from './subtree';
export * from './tree';
